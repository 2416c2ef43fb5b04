// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "trismooth/smoothing/parts/part_messenger.h"

namespace trismooth {

/// Threads of this process that smooth the parts of a mesh, one each, and the ways between them.
class ThreadTeam {
 public:
  /// `parts`: one at least.
  explicit ThreadTeam(int parts);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;
  ~ThreadTeam();

  int count() const;
  /// Of a part, from 0; to be used within run() alone.
  std::shared_ptr<PartMessenger> messenger(int part) const;

  /// Calls task(part) for all parts at the same time: for part 0 on this thread, for each of the others on a thread of
  /// its own. Returns when all have. Where one throws, the others wait for it no longer: what they wait for throws as
  /// well. The exception that was first reaches the caller.
  void run(const std::function<void(int)>& task);

 private:
  class Meeting;
  class Messenger;

  std::shared_ptr<Meeting> meeting_;
};

}  // namespace trismooth

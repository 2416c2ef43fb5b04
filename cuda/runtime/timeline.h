// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/runtime/context.h"

namespace trismooth::cuda {

/// Moments in the work of a stream, for the time between them.
class Timeline {
 public:
  explicit Timeline(const Context& context) : context_(context) {}
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;
  ~Timeline();

  /// Marks the moment when all that is queued so far will be done.
  void mark();
  /// Forgets all moments from `moment` on.
  void rewind(std::size_t moment = 0) { marked_ = moment; }
  /// Milliseconds from moment `from` to the next; waits for the latter.
  double milliseconds(std::size_t from) const;

 private:
  const Context& context_;
  std::vector<cudaEvent_t> events_;  ///< made once; those from marked_ on wait to be used again
  std::size_t marked_ = 0;
};

}  // namespace trismooth::cuda

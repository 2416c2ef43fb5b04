// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/traffic.h"
#include "trismooth/smoothing/parts/part_messenger.h"

namespace trismooth::mpi {

/// Ghosts' values and sums by MPI. Parts are ranks.
class Messenger final : public PartMessenger {
 public:
  /// Of these ranks. Local.
  explicit Messenger(std::shared_ptr<const Communicator> communicator);
  /// Local.
  ~Messenger() override;

  /// Begins to send and to receive. Collective between neighbours: whom a message is for calls it as well.
  void start(std::span<const Message> sends, std::span<const Message> receives) override;
  /// Waits for all that was started. Collective between neighbours.
  void finish() override;
  /// Joins the sums of all ranks. Collective.
  void join(PartSums& sums) override;

  /// What this rank has sent so far. Local.
  const Traffic& traffic() const { return traffic_; }

 private:
  std::shared_ptr<const Communicator> communicator_;
  std::vector<MPI_Request> requests_;
  Traffic traffic_;
};

}  // namespace trismooth::mpi

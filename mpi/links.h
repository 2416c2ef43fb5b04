#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/traffic.h"
#include "trismooth/smoothing/parts/part_links.h"

namespace trismooth::mpi {

/// Ghosts' values and sums by MPI. Parts are ranks.
class Links final : public PartLinks {
 public:
  explicit Links(std::shared_ptr<const Communicator> communicator);
  ~Links() override;

  void start(std::span<const Message> sends, std::span<const Message> receives) override;
  void finish() override;
  void join(PartSums& sums) override;

  const Traffic& traffic() const { return traffic_; }

 private:
  std::shared_ptr<const Communicator> communicator_;
  std::vector<MPI_Request> requests_;
  Traffic traffic_;
};

}  // namespace trismooth::mpi

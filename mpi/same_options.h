#pragma once

#include "trismooth/mpi/communicator.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/sliding.h"

namespace trismooth::mpi {

/// Throws std::invalid_argument on all ranks, naming the first option that is not the same on all of them. Threads,
/// target lengths, progress and the lines and links to slide on may differ.
void require_same_options(const SmoothingOptions& options, const Sliding& slide, bool gathers,
                          const Communicator& communicator);

}  // namespace trismooth::mpi

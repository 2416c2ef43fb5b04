// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// Calls `run`, which is run_pipeline() or like it, on rank 0, which has the whole mesh in its memory, with these
/// options and, of several ranks, a backend whose sweeps all make: the others have their part of the vertices, give
/// what they did back and take part until it returns or throws. What is not done in pieces (sliding, untangling) rank 0
/// does alone, and says so. Collective: throws the same on all ranks. The result is rank 0's, that of other ranks is
/// empty.
PipelineResult run_on_first(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks,
                            const std::function<PipelineResult(const PipelineOptions&)>& run);

}  // namespace trismooth

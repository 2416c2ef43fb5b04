#pragma once

#include <functional>
#include <memory>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// Calls `run` on rank 0, with these options and, of several ranks, a backend whose sweeps all make; the others take
/// part until it returns or throws. What is not done in pieces (sliding, untangling) rank 0 does
/// alone, and says so. Collective: throws the same on all ranks. The result of other ranks is empty.
PipelineResult run_on_first(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks,
                            const std::function<PipelineResult(const PipelineOptions&)>& run);

/// run_pipeline() of a mesh in one file, whose sweeps are made by all ranks of an MPI job: rank 0 reads and writes it,
/// and reports on it, with the whole mesh in its memory; the others have their part of the vertices and give what they
/// did back. What is not done in pieces (sliding, untangling) rank 0 does alone. Files, figures and errors are those of
/// run_pipeline(). Collective: throws the same on all ranks. The result is rank 0's, that of other ranks is empty.
PipelineResult run_one_file(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// run_pipeline() over the ranks of an MPI job, whose options are to be the same on all of them. A mesh in pieces, and
/// a file that is written in pieces, each rank has a part of (run_pieces()); so it has of a file that is only looked
/// at, where that can be read by ranges. All else is rank 0's, and all ranks make the sweeps. Collective: throws the
/// same on all ranks. The result is complete on rank 0.
PipelineResult run_over_ranks(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks);

}  // namespace trismooth

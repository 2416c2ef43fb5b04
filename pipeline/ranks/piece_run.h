// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// run_pipeline() of a mesh in pieces, over the ranks of an MPI job: each reads some of the pieces, has their part of
/// the work and writes them. Files and figures are the same for every number of ranks, and the coordinates those of the
/// mesh as one file, with its vertices in the order of their global ids. Callbacks of the options are called where they
/// are set. Collective: throws the same on all ranks, what run_pipeline() throws, and std::invalid_argument for options
/// that are not there for pieces. The result is complete on every rank, but for timings, which are the rank's.
/// An input that is one file is shared out first: read by ranges, or else by rank 0 as a whole, which a note says. What
/// is not done in pieces yet rank 0 does, as run_gathered() and run_file_gathered(), which a note says as well; and so
/// does the one rank of a job, for which there is nothing to share.
PipelineResult run_pieces(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks);

/// run_pieces() of an input that is one file and can be read by ranges. Throws ReadError for others. Collective.
PipelineResult run_by_ranges(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks);

}  // namespace trismooth

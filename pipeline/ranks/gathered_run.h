// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// The stages of run_pipeline() behind reading for a mesh in pieces, with the whole mesh in the memory of rank 0, which
/// does all but the sweeps for all: coordinates and figures are those of the mesh as one file, whatever the options.
/// The output is the pieces, or with PipelineOptions::single one file. Piece::ids are known. Collective: throws the
/// same on all ranks. The result is rank 0's, that of other ranks is empty.
PipelineResult run_gathered(PieceFiles& files, const PipelineOptions& options,
                            const std::shared_ptr<const mpi::Communicator>& communicator, Workers& workers);

/// run_pipeline() of one file, by rank 0 with the whole mesh in its memory, which does all but the sweeps for all. The
/// output is pieces, in which the result is shared out. Collective: throws the same on all ranks. The result is rank
/// 0's, that of other ranks is empty.
PipelineResult run_file_gathered(const PipelineOptions& options,
                                 const std::shared_ptr<const mpi::Communicator>& communicator, Workers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// Writes the pieces with their points as they are now as one file, the output of the options, by rank 0 with the whole
/// mesh in its memory. What the file does not hold is added to the result's losses. When it is complete beside its
/// target, `completed` and the options' `beside` are asked as by write_pieces(). Collective. Throws WriteError on all
/// ranks, and what `beside` throws; whatever stood there survives that.
void write_single(PieceFiles& files, const PipelineOptions& options, const mpi::Communicator& ranks, Workers& workers,
                  PipelineResult& result, const std::function<const PipelineResult&()>& completed);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// Checks what pieces have in common: a vertex must have the same coordinates, bit for bit, in all of them, and a
/// triangle that two pieces have must be a ghost in one. Piece::ids are known. Collective. Throws ReadError on all
/// ranks. Complexity: n log n in what the rank has; ids are scattered over the ranks.
void check_shared_vertices(const PieceFiles& files, const mpi::Communicator& ranks);

}  // namespace trismooth

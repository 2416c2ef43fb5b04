// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// Gives every point its number in the whole mesh (Piece::ids), and says whether the pieces have these. That is what
/// the point array says which is marked as global ids, or called GlobalNodeIds or GlobalPointIds. Where the pieces have
/// none, points of several pieces at the same place, bit for bit, are one vertex, and vertices are numbered from 0 as
/// they come over the pieces in their order. Collective. Throws ReadError on all ranks for numbers that are negative or
/// twice in a piece, and for places at which it cannot be told which points are one. Complexity: n log n in what the
/// rank has; places are scattered over the ranks, none has them all.
void number_vertices(PieceFiles& files, const mpi::Communicator& ranks);

}  // namespace trismooth

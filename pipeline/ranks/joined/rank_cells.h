// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/input/element_cells.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// The cells of all pieces, copies left out.
struct RankCells {
  std::int64_t first = 0;  ///< the number of the rank's first cell among them
  std::int64_t cells = 0;
  std::int64_t others = 0;           ///< that are no elements
  std::int64_t lines = 0;            ///< those of them that are lines or curves
  RepeatingCells repeating;          ///< those of them that repeat a vertex, by number_of_cell()
  std::int64_t held_quads = 0;       ///< quadrilaterals among the others
  std::int64_t collapsed_quads = 0;  ///< CellTriangle::is_quad
};

/// Counts them. Collective. Complexity: linear.
RankCells count_rank_cells(const PieceFiles& files, const mpi::Communicator& ranks);

/// The number_of_cell() of a triangle by its number among those of the rank's pieces; 0 where it is none of them.
/// `first`: RankCells::first. Local. Complexity: linear in the cells before it.
std::int64_t number_of_triangle(const PieceFiles& files, std::int64_t first, std::int32_t triangle);

}  // namespace trismooth

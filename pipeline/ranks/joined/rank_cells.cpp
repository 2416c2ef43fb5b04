// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_cells.h"

#include <algorithm>
#include <limits>

#include <mpi.h>

#include "trismooth/pipeline/ranks/piece.h"

namespace trismooth {

RankCells count_rank_cells(const PieceFiles& files, const mpi::Communicator& ranks) {
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  OwnCells cells;
  std::int64_t first_repeating = none;
  for (const Piece& piece : files.pieces) {
    const OwnCells of_piece = count_own_cells(piece);
    if (of_piece.first_repeating >= 0) {
      first_repeating = std::min(first_repeating, number_of_cell(piece, of_piece.first_repeating, cells.cells));
    }
    cells.others += of_piece.others;
    cells.repeating += of_piece.repeating;
    cells.cells += of_piece.cells;
  }
  RankCells all;
  all.first = ranks.sum_before(cells.cells);
  if (first_repeating < none && !files.know_cell_ids()) {
    first_repeating += all.first;
  }
  all.repeating = ranks.sum(cells.repeating);
  MPI_Allreduce(MPI_IN_PLACE, &first_repeating, 1, MPI_INT64_T, MPI_MIN, ranks.handle());
  if (first_repeating < none) {
    all.first_repeating = static_cast<std::size_t>(first_repeating);
  }
  all.others = ranks.sum(cells.others);
  all.cells = ranks.sum(cells.cells);
  return all;
}

std::int64_t number_of_triangle(const PieceFiles& files, std::int64_t first, std::int32_t triangle) {
  for (const Piece& piece : files.pieces) {
    const auto count = static_cast<std::int32_t>(piece.mesh.elements.size());
    if (triangle >= 0 && triangle < count) {
      return number_of_cell(piece, piece.mesh.cells[static_cast<std::size_t>(triangle)], first);
    }
    triangle -= count;
    first += std::ranges::count(piece.ghost_cells, 0);
  }
  return 0;
}

}  // namespace trismooth

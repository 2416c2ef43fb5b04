// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_cells.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <mpi.h>

#include "trismooth/pipeline/ranks/piece.h"

namespace trismooth {

RankCells count_rank_cells(const PieceFiles& files, const mpi::Communicator& ranks) {
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  OwnCells cells;
  std::array firsts{none, none};  // triangle, quadrilateral
  for (const Piece& piece : files.pieces) {
    const OwnCells of_piece = count_own_cells(piece);
    const auto take_first = [&](std::optional<std::size_t> cell, std::int64_t& first) {
      if (cell) {
        first = std::min(first, number_of_cell(piece, static_cast<std::int64_t>(*cell), cells.cells));
      }
    };
    take_first(of_piece.repeating.first_triangle, firsts[0]);
    take_first(of_piece.repeating.first_quad, firsts[1]);
    cells.others += of_piece.others;
    cells.lines += of_piece.lines;
    cells.held_quads += of_piece.held_quads;
    cells.collapsed_quads += of_piece.collapsed_quads;
    cells.repeating.triangles += of_piece.repeating.triangles;
    cells.repeating.quads += of_piece.repeating.quads;
    cells.cells += of_piece.cells;
  }
  RankCells all;
  all.first = ranks.sum_before(cells.cells);
  for (std::int64_t& first : firsts) {
    first += first < none && !files.know_cell_ids() ? all.first : 0;
  }
  MPI_Allreduce(MPI_IN_PLACE, firsts.data(), static_cast<int>(firsts.size()), MPI_INT64_T, MPI_MIN, ranks.handle());
  all.repeating = {ranks.sum(cells.repeating.triangles), ranks.sum(cells.repeating.quads),
                   static_cast<std::size_t>(firsts[0]), static_cast<std::size_t>(firsts[1])};
  all.others = ranks.sum(cells.others);
  all.lines = ranks.sum(cells.lines);
  all.held_quads = ranks.sum(cells.held_quads);
  all.collapsed_quads = ranks.sum(cells.collapsed_quads);
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

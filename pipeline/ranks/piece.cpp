// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/piece.h"

#include <algorithm>

#include "trismooth/base/cell_list.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

OwnCells count_own_cells(const Piece& piece) {
  const CellList& cells = piece.document.cells;
  OwnCells count;
  std::vector<std::uint8_t> has_triangles(cells.size(), 0);
  for (std::size_t t = 0; t < piece.mesh.elements.size(); ++t) {
    has_triangles[static_cast<std::size_t>(piece.mesh.cells[t])] = 1;
    count.triangles += piece.is_ghost(t) ? 0 : 1;
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (piece.ghost_cells[c] != 0) {
      continue;
    }
    ++count.cells;
    if (has_triangles[c] == 0) {
      ++count.others;
      count.lines += cell_type::dimension(cells.types[c]) == 1 ? 1 : 0;
      count.repeating.count(cells.types[c], cells[c], c);
      count.held_quads += quad_of_cell(cells.types[c], cells[c]) ? 1 : 0;
    } else if (const auto triangle = triangle_of_cell(cells.types[c], cells[c])) {
      count.collapsed_quads += triangle->is_quad ? 1 : 0;
    }
  }
  return count;
}

std::int64_t number_of_cell(const Piece& piece, std::int64_t cell, std::int64_t before) {
  if (!piece.cell_ids.empty()) {
    return piece.cell_ids[static_cast<std::size_t>(cell)];
  }
  return before + std::count(piece.ghost_cells.begin(), piece.ghost_cells.begin() + cell, 0);
}

bool holds_something(const Piece& piece) {
  return piece.document.point_count() > 0 || piece.document.cells.size() > 0;
}

std::vector<std::uint8_t> ghost_cells_of(const MeshDocument& document) {
  constexpr unsigned duplicate_cell = 1;
  std::vector<std::uint8_t> ghosts(document.cells.size(), 0);
  const DataArray* const types = find_array(document.cell_arrays, ghost_flags_name);
  if (types != nullptr && types->type == ScalarType::uint8 && types->components == 1) {
    const auto values = types->as<std::uint8_t>();
    for (std::size_t c = 0; c < ghosts.size(); ++c) {
      ghosts[c] = static_cast<std::uint8_t>(values[c] & duplicate_cell);
    }
  }
  return ghosts;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/strip_triangles.h"

#include <algorithm>

#include "trismooth/mesh_io/document/cells/replaced_cells.h"

namespace trismooth {

bool has_strips(const MeshDocument& document) {
  return std::ranges::find(document.cells.types, cell_type::triangle_strip) != document.cells.types.end();
}

MeshDocument with_strips_as_triangles(const MeshDocument& document) {
  return with_replaced_cells(document, [&document](std::size_t cell, CellList& cells) {
    if (document.cells.types[cell] != cell_type::triangle_strip) {
      return false;
    }
    for_each_strip_triangle(document.cells[cell],
                            [&](const Triangle& triangle) { cells.append(cell_type::triangle, triangle); });
    return true;
  });
}

}  // namespace trismooth

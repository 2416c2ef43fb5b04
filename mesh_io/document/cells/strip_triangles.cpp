// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/strip_triangles.h"

#include <algorithm>
#include <vector>

#include "trismooth/mesh_io/document/array_rows.h"

namespace trismooth {

bool has_strips(const MeshDocument& document) {
  return std::ranges::find(document.cells.types, cell_type::triangle_strip) != document.cells.types.end();
}

MeshDocument with_strips_as_triangles(const MeshDocument& document) {
  MeshDocument expanded = document;
  expanded.original = nullptr;
  expanded.cells = {};
  std::vector<std::size_t> cell_of;  // of each new cell
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    if (document.cells.types[cell] == cell_type::triangle_strip) {
      for_each_strip_triangle(document.cells[cell],
                              [&](const Triangle& triangle) { expanded.cells.append(cell_type::triangle, triangle); });
    } else {
      expanded.cells.append(document.cells.types[cell], document.cells[cell]);
    }
    cell_of.resize(expanded.cells.size(), cell);
  }
  for (DataArray& array : expanded.cell_arrays) {
    array = with_rows(array, cell_of);
  }
  return expanded;
}

}  // namespace trismooth

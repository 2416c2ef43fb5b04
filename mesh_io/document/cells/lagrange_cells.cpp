// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/lagrange_cells.h"

namespace trismooth {

bool has_cells_of_any_order(const MeshDocument& document) {
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    if (ordinary_type(document.cells.types[cell], document.cells[cell].size()) != document.cells.types[cell]) {
      return true;
    }
  }
  return false;
}

MeshDocument with_fixed_orders(const MeshDocument& document) {
  MeshDocument fixed = document;
  fixed.original = nullptr;
  for (std::size_t cell = 0; cell < fixed.cells.size(); ++cell) {
    fixed.cells.types[cell] = ordinary_type(fixed.cells.types[cell], fixed.cells[cell].size());
  }
  return fixed;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/document/array_rows.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The document with others in place of some cells, where these are: replace(cell, cells) appends them to `cells` and
/// answers true, or false for a cell that stays. Each has the row of the cell arrays, and is in the sets, of the one
/// that it stands for. Without an original. Linear.
template <class Replace>
MeshDocument with_replaced_cells(const MeshDocument& document, const Replace& replace) {
  MeshDocument replaced = document;
  replaced.original = nullptr;
  replaced.cells = {};
  std::vector<std::size_t> cell_of;   // of each new cell
  std::vector<std::size_t> first_of;  // of each cell the first new one
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    first_of.push_back(cell_of.size());
    if (!replace(cell, replaced.cells)) {
      replaced.cells.append(document.cells.types[cell], document.cells[cell]);
    }
    cell_of.resize(replaced.cells.size(), cell);
  }
  first_of.push_back(cell_of.size());
  for (DataArray& array : replaced.cell_arrays) {
    array = with_rows(array, cell_of);
  }
  for (NamedSet& set : replaced.cell_sets) {
    for (const std::int32_t cell : std::exchange(set.members, {})) {
      for (std::size_t i = first_of[static_cast<std::size_t>(cell)]; i < first_of[static_cast<std::size_t>(cell) + 1];
           ++i) {
        set.members.push_back(static_cast<std::int32_t>(i));
      }
    }
  }
  return replaced;
}

}  // namespace trismooth

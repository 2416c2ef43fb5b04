// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace trismooth {

class Workers;
struct ElementCells;

/// A cell of the document, or of a strip a part, that is an element of the mesh once more.
struct CellCopy {
  std::int32_t element;  ///< of the mesh
  std::int32_t cell;     ///< of the document

  bool operator==(const CellCopy&) const = default;
};

/// The copies that are of this cell. `copies` ascend by their cells. Complexity: log n.
std::span<const CellCopy> copies_in_cell(std::span<const CellCopy> copies, std::int32_t cell);

/// Makes the mesh one of the elements that are not `left_out` (ascending). Returns the numbers that its elements have
/// then, -1 for those left out. Complexity: linear.
std::vector<std::int32_t> leave_out(ElementCells& mesh, std::span<const std::int32_t> left_out);

/// Counts the element, which is to be left out, as another cell, and holds its vertices, those between corners too.
/// Complexity: log n.
void hold_as_other_cell(ElementCells& mesh, std::int32_t element);

/// Takes elements that have the sides of one before them, in whatever order, out of those of the mesh, which has
/// each once then: they are its `copies`. Programs list elements again for every group that has them. A triangle of six
/// nodes whose middles are others counts as another cell: its vertices are held. Notes say how many there are of both.
/// To be called when the mesh's elements are what they stay. Complexity: as find_repeated_triangles().
void take_out_copies(ElementCells& mesh, Workers& workers);

}  // namespace trismooth

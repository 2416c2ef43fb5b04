// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Cells that a file keeps together under one number, and perhaps a name: a physical group, a marker, an element set.
struct CellGroup {
  int dimension = 2;        ///< of its cells: see cell_type::dimension()
  std::int64_t number = 0;  ///< the value of the array; unique for the dimension
  std::string name;         ///< empty: none
  /// The place among the document's cell_sets of the one of its name that has all its cells, and those that are in
  /// others' groups first, where groups overlap; -1: there is none.
  std::int32_t whole_set = -1;
  bool is_empty = false;  ///< no cell has the number, whose name the file gives, and no set of cells is called so
};

/// The name of the set of all cells of a group without a name: "physical 3".
std::string name_of_unnamed_group(std::int64_t number);

/// The cell arrays that groups are from.
struct GroupArrays {
  std::array<std::string, 4> of_dimension;  ///< by that of the cells; empty: these are without a group

  /// Whether groups are from the array of that name.
  bool has(std::string_view name) const;
  /// Their names, each once, as a list.
  std::string text() const;
};

/// The groups that a format with one number for a cell gets from a document.
struct CellGroups {
  GroupArrays arrays;
  std::vector<std::int32_t> of_cell;  ///< a place in `groups` for every cell; -1: none. Empty where no array has groups
  std::vector<CellGroup> groups;      ///< ascending by dimension and number
};

/// The groups by the document's cell array that says most of them: the first that has value_names, else the first of
/// whole numbers and one component whose name is_region_name(), else none. Where it has but 0 at all lines, or at all
/// points, they are grouped by the first array of whole numbers that has others than 0 there and 0 at all other cells,
/// whatever its name: tags of sides, as dolfinx writes them to a grid of their own. Groups of several arrays that have
/// no name are called after their array and number ("bottom_3"). Values of 0 without a name are no group, where the
/// array has value_names or other values of the dimension. Complexity: n log g for g groups, linear in the cell_sets,
/// and in cells and arrays for tags of sides.
CellGroups find_cell_groups(const MeshDocument& document);

}  // namespace trismooth

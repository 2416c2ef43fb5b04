// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
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
};

/// The name of the set of all cells of a group without a name: "physical 3".
std::string name_of_unnamed_group(std::int64_t number);

/// The groups that a format with one number for a cell gets from a document.
struct CellGroups {
  std::string array;                  ///< the cell array that they are from; empty: all cells are without a group
  std::vector<std::int32_t> of_cell;  ///< a place in `groups` for every cell; -1: none. Empty where `array` is
  std::vector<CellGroup> groups;      ///< ascending by dimension and number; each has a cell
};

/// The groups by the document's cell array that says most of them: the first that has value_names, else the first of
/// whole numbers and one component whose name is_region_name(), else none. Values of 0 without a name are no group,
/// where the array has value_names or other values of the dimension. Complexity: n log g for g groups, and linear in
/// the cell_sets.
CellGroups find_cell_groups(const MeshDocument& document);

}  // namespace trismooth

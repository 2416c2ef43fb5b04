// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// A group as a file lists it: groups may overlap, and have cells of several dimensions.
struct ListedGroup {
  std::int64_t number = 0;          ///< 0: none
  std::string name;                 ///< empty: none; of groups without cells: one
  std::vector<std::int32_t> cells;  ///< ascending, each once
};

/// Adds to the document, whose cells are there, the cell array `array` with the number of the smallest group of each
/// cell (the first of these; 0: in none) and the names of these numbers: a group of all faces is no region beside those
/// of the materials, wherever it stands. A group of which others have cells becomes a set of cells as well. Groups
/// without a number, and those whose number another has, get further ones. Groups without cells become sets of cells
/// without members. Returns whether there is an array: false where no group has a cell. Complexity: n log n in all
/// members.
bool add_listed_groups(const std::string& array, std::vector<ListedGroup> groups, MeshDocument& document);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// All groups that a format gets from a document whose groups may overlap: those of find_cell_groups(), the sets of
/// cells and those of points. Groups of one name are one; those without a name are called after their number.
struct GroupLists {
  GroupArrays arrays;                               ///< the cell arrays that groups are from
  std::vector<std::string> names;                   ///< each once, in the order in which they come first
  std::vector<std::vector<std::size_t>> of_cells;   ///< the groups of each cell as places in `names`, ascending
  std::vector<std::vector<std::size_t>> of_points;  ///< likewise
  std::vector<std::size_t> empty_of_cells;          ///< those that no cell and no point is in, of cells
  std::vector<std::size_t> empty_of_points;         ///< likewise, of points
};

/// Complexity: n log n in all members.
GroupLists list_groups(const MeshDocument& document);

/// Names as a format can hold them.
struct FittedNames {
  std::vector<std::string> names;    ///< one for each, no two alike
  std::vector<std::string> renamed;  ///< "'a b ' (as a b)"
};

/// Names of `most` characters at most, which is 20 or more, without blanks around them; control characters and those of
/// `others` become '_'. Names that are so already stay. `names`: no two alike.
FittedNames fit_names(const std::vector<std::string>& names, std::size_t most, std::string_view others = {});

}  // namespace trismooth

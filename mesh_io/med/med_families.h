// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Characters of the name of a group in a MED file, which blanks fill up.
inline constexpr std::size_t med_group_name_size = 80;

/// What MED tells groups by: points, or cells of a dimension, that are in the same groups.
struct MedFamily {
  std::int64_t number = 0;          ///< above 0: of points, below: of cells; each once
  std::vector<std::size_t> groups;  ///< places among the names, ascending
};

/// The families that a MED file needs to hold the groups and sets of a document.
struct MedFamilies {
  std::vector<std::string> group_names;  ///< as they are written; no two alike
  std::vector<std::string> renamed;      ///< "'a b ' (as a b)"
  GroupArrays arrays;                    ///< the cell arrays that groups are from
  std::vector<MedFamily> of_points;
  std::vector<MedFamily> of_cells;
  std::vector<std::int64_t> point_families;  ///< the number of each point's family; empty: none is in a set
  std::vector<std::int64_t> cell_families;   ///< likewise
};

/// Complexity: n log n in all members.
MedFamilies plan_med_families(const MeshDocument& document);

}  // namespace trismooth

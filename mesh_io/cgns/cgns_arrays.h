// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Characters of the name of a node of CGNS.
inline constexpr std::size_t most_cgns_name_size = 32;
/// A slash stands between the names of a path.
inline constexpr std::string_view no_cgns_name_characters = "/";

/// A component of an array as an array of CGNS.
struct CgnsComponent {
  const DataArray* array = nullptr;  ///< of the document
  std::size_t component = 0;
  std::string name;
};

/// What is written of arrays of points or of cells.
struct CgnsArrays {
  std::vector<CgnsComponent> components;  ///< no two of a name
  std::vector<std::string> renamed;       ///< "'a/b' (as a_b)"
  std::vector<std::string> split;         ///< "stress (stress_1 to stress_4)": do not come back as one array
};

/// All of `arrays`, which outlive the result, but those that groups are from. Arrays of two and three components
/// have "X", "Y" and "Z" behind their name, as the SIDS wants vectors. Complexity: n log n in the components.
CgnsArrays plan_cgns_arrays(const std::vector<DataArray>& arrays, const GroupArrays& left_out);

}  // namespace trismooth

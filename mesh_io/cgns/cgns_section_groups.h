// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "trismooth/mesh_io/cgns/cgns_sections.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The groups that the sections of a zone are where nothing else makes any: each section under its name, but for those
/// of faces that differ in the type of their elements alone. Of one name but for that ("copper_tri", "copper_quad")
/// they are one group; where all sections of faces are so, or differ in numbers besides ("Elements_5", "Elements_7"),
/// they are the one region that there is, and no group.
struct CgnsSectionGroups {
  std::vector<NamedSet> groups;
  bool are_joined = false;  ///< by a guess: some sections are no group of their own, and their names may mean more
};

/// Complexity: linear in the cells, n log n in the sections.
CgnsSectionGroups group_cgns_sections(const CgnsSections& sections, const CellList& cells);

}  // namespace trismooth

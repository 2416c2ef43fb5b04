// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// A group as the file lists it: ids of nodes and elements.
struct UnvGroup {
  std::int64_t number = 0;
  std::string name;  ///< empty: none
  std::vector<std::int64_t> nodes;
  std::vector<std::int64_t> elements;
};

/// Adds to the document, whose cells are there, the array unv:group of the smallest group of each cell (the first of
/// these), groups of which others have cells as sets of cells, nodes as sets of points, and a note where a group names
/// what is not there. `nodes` and `elements` tell the places of ids. Complexity: n log n in all members.
void add_unv_groups(std::vector<UnvGroup> groups, const PointIds& nodes, const PointIds& elements,
                    MeshDocument& document);

}  // namespace trismooth

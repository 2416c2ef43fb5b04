// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/msh/msh_entities.h"
#include "trismooth/mesh_io/msh/msh_rows.h"
#include "trismooth/mesh_io/msh/msh_tags.h"

namespace trismooth {

/// The elements of a file. Their types and vertices are the document's cells.
struct MshElements {
  MshTags tags;
  // Of every cell, with cells at the end left out that have 0.
  std::vector<std::int32_t> physical;     ///< the group that is named first; 0: none
  std::vector<std::int32_t> geometrical;  ///< the entity
  std::vector<std::int32_t> partition;    ///< 0: none
  /// Cells in groups beside the first one: by dimension and group, ascending.
  std::map<std::pair<int, std::int32_t>, std::vector<std::int32_t>> further_groups;
  std::vector<std::int32_t> cells;  ///< of every element; empty where element i is cell i
  std::size_t repeated = 0;         ///< elements that are the same cell as one before, in another group
};

/// Reads the section $Elements, or $ELM of version 1, behind its first line up to its end.
void read_msh_elements(MshInput& input, MshRows& rows, const MshTags& nodes, MshEntities& entities,
                       MeshDocument& document, MshElements& elements);

}  // namespace trismooth

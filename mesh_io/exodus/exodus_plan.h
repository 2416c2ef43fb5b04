// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/exodus/exodus_elements.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Cells of one type and group.
struct ExodusPlanBlock {
  std::int64_t id = 0;
  std::string name;
  std::int64_t region = 0;          ///< the id of the first block of its group; 0: of no group
  ExodusShape shape;                ///< without nodes: polygons
  std::vector<std::int32_t> cells;  ///< in the document's order
};

/// Elements, nodes or sides that are written under a name.
struct ExodusPlanSet {
  std::int64_t id = 0;
  std::string name;
  std::vector<std::int32_t> members;  ///< elements or nodes, from 0
  std::vector<std::int32_t> sides;    ///< of these elements, from 0; of side sets
};

/// What is written of a document. Cells of a group become a block for each type, the first
/// of them under the group's number and name. Lines of a group, or of a set, that
/// are sides of faces become a side set, as programs want boundaries; all other lines are blocks.
struct ExodusPlan {
  GroupArrays group_arrays;  ///< the cell arrays that blocks and side sets are from
  std::vector<ExodusPlanBlock> blocks;
  std::vector<std::int32_t> element_of;  ///< of each cell, from 0; -1: none
  std::size_t elements = 0;
  bool keeps_order = true;  ///< elements are in the order of cells
  std::vector<ExodusPlanSet> side_sets;
  std::vector<ExodusPlanSet> element_sets;
  std::vector<ExodusPlanSet> node_sets;
  std::size_t lines_as_sides = 0;              ///< lines that are no elements
  std::vector<std::string> renumbered_blocks;  ///< "0 (wall) to 3": groups that are written under another number
  std::vector<std::string> renumbered_sets;    ///< likewise, of side sets
  std::vector<std::string> renamed;            ///< "wall (as wall_1)"
  std::vector<std::string> split;              ///< "wall (3, 5)": groups of several blocks
  bool has_regions = false;  ///< some group has several blocks of faces, or a block beside others is of none
};

/// Complexity: linear, but for n log n in the lines.
ExodusPlan make_exodus_plan(const MeshDocument& document);

}  // namespace trismooth

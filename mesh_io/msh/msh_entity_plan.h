// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// An entity that cells and points of a document are written on.
struct MshPlannedEntity {
  int dimension = 2;
  std::int32_t tag = 1;                  ///< unique for the dimension
  std::vector<std::int32_t> physical{};  ///< the groups that it is in
};

struct MshPlannedGroup {
  int dimension = 2;
  std::int32_t tag = 1;  ///< unique for the dimension
  std::string name;      ///< may be empty
};

/// The geometry that an MSH file of version 4 needs to hold the groups of a document: an entity for every set of groups
/// that cells of a dimension are in, and one for every point cell.
struct MshEntityPlan {
  std::vector<MshPlannedEntity> entities;  ///< ascending by dimension, then tag
  std::vector<MshPlannedGroup> groups;     ///< ascending by dimension
  std::vector<std::int32_t> of_cell;       ///< a place in `entities`; -1 for cells that are not written
  std::vector<std::int32_t> of_point;      ///< the one of the lowest dimension that has the point
  std::vector<int> element_types;          ///< of every cell, Gmsh's number; 0: not written
  GroupArrays group_arrays;                ///< the cell arrays that the groups are from
  bool keeps_entities = false;             ///< the tags are those of the array gmsh:geometrical
  bool renumbers_groups = false;           ///< some group's number is none that Gmsh can have
  std::vector<std::string> renamed{};      ///< "'a"b' (as a_b)": groups whose names Gmsh cannot have
  /// Groups, without names, of the cells that the document has in none, one a dimension, where it has groups at all:
  /// programs that save a file again leave out what is in no group, or cannot open it.
  std::vector<MshPlannedGroup> rests{};
};

/// Complexity: n log g in the cells and their groups.
MshEntityPlan plan_msh_entities(const MeshDocument& document);

}  // namespace trismooth

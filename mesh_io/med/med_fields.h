// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Characters of the name of a component of a field, and of its unit.
inline constexpr std::size_t med_component_size = 16;

/// Instead of a list of nodes or elements: all.
inline constexpr std::string_view med_all_entities = "MED_NO_PROFILE_INTERNAL";

/// The elements of a type, which are cells that follow each other.
struct MedBlock {
  std::string type;   ///< "TR3"
  std::string group;  ///< that has them
  std::size_t first;  ///< cell
  std::size_t count;
};

/// The fields of a mesh in a MED file.
struct MedFields {
  std::vector<DataArray> point_arrays;  ///< those that have values at all of its nodes
  std::vector<DataArray> cell_arrays;   ///< those at all elements of a type: others have 0, or no number
  std::vector<Hdf5Column> columns;      ///< where the values at nodes are
  std::vector<std::string> notes;       ///< of all others, that they are kept
};

/// Reads the fields (/CHA) of the mesh of that name, whose nodes, blocks of elements and arrays are those of the
/// document. Complexity: linear in their values.
MedFields read_med_fields(const Hdf5Reader& file, const std::string& mesh, std::span<const MedBlock> blocks,
                          const MeshDocument& document, MemberBudget& budget);

}  // namespace trismooth

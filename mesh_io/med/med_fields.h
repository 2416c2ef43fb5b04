// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The fields of a mesh in a MED file.
struct MedFields {
  std::vector<DataArray> arrays;    ///< those that have values at all of its nodes
  std::vector<Hdf5Column> columns;  ///< where these values are
  std::vector<std::string> notes;   ///< of all others, that they are kept
};

/// Reads the fields (/CHA) of the mesh of that name, which has so many nodes. Complexity: linear in their values.
MedFields read_med_fields(const Hdf5Reader& file, const std::string& mesh, std::size_t nodes, MemberBudget& budget);

}  // namespace trismooth

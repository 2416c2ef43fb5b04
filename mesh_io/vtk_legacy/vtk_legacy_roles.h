// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The two kinds of data of a legacy VTK file.
enum class VtkLegacyData : std::uint8_t { points, cells };

/// What stands in front of the numbers of the array, named `encoded_name` there, so that VTK takes it in its role:
/// "VECTORS velocity double\n". Nothing for an array that has none of the roles that the format knows.
std::optional<std::string> vtk_legacy_role_header(const DataArray& array, const std::string& encoded_name,
                                                  VtkLegacyData data);

/// The METADATA block behind an array: names of components and information; empty where there is nothing to say.
std::string vtk_legacy_metadata(const ArrayDescription* description);

/// What of the descriptions of its arrays the format cannot hold, one sentence each.
std::vector<std::string> lost_in_vtk_legacy(const MeshDocument& document);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes the document as a CGNS file in HDF5: one zone with a section of points,
/// one of lines, of faces and of solids (MIXED where they are of several types)
/// and one of polygons, a boundary condition and a family for each group and set.
/// Throws WriteError. Complexity: n log n in the members of groups and sets.
void write_cgns(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// What CGNS does not hold of it, one sentence each.
std::vector<std::string> lost_in_cgns(const MeshDocument& document);

}  // namespace trismooth

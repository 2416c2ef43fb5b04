// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes the document as an SU2 mesh of two dimensions: its points, then its triangles and quads, then markers. A
/// marker is a group of lines (see find_cell_groups), under its name, or marker_N for one that is a number alone. Lines
/// of no group, and edges at the boundary that are no line, are the marker boundary: SU2 takes no mesh whose boundary
/// is not marked. Throws WriteError, also for a mesh that is not flat.
void write_su2(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// What write_su2() leaves out, or adds, one sentence each.
std::vector<std::string> lost_in_su2(const MeshDocument& document);

}  // namespace trismooth

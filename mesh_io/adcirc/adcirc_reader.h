// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an ADCIRC grid (fort.14): nodes, triangles and quadrilaterals, open and land boundaries as sets of points, the
/// depths of the nodes as the point array "depth". Throws ReadError.
MeshDocument read_adcirc(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

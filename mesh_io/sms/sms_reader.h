// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an SMS mesh (2dm): nodes, elements, nodestrings as sets of points, materials as the cell array "2dm:material",
/// the third coordinates of the nodes as the point array "elevation". Throws ReadError.
MeshDocument read_sms(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an XDMF file, and the files beside it that it refers to. Grids over the same points are one mesh: cells that a
/// later grid has again (tags of dolfinx) are not added, and its arrays go to the cells that are there. Of time steps
/// the values of the last one are read; points and cells of all must be the same. Throws ReadError.
MeshDocument read_xdmf(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

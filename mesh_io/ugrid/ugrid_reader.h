// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads the mesh of two dimensions of a netCDF file with the UGRID conventions, `bytes` being the whole of it: nodes,
/// faces and, as lines behind these, boundary edges. Numbers at nodes and faces that have no time become arrays; real
/// ones at nodes say something of the place (depths), and are written back. All else stays in the file that is written
/// back: a note names places of faces and edges, and values of times. Throws ReadError.
MeshDocument read_ugrid(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

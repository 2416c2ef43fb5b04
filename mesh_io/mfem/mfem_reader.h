#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an MFEM mesh v1.0, v1.1, v1.2 or v1.3 with vertices (https://mfem.org/mesh-formats/). The attributes of
/// elements and of the boundary are the cell array "mfem:attribute"; a named set of one attribute names it, other sets
/// are sets of cells. Throws ReadError, also for curved meshes (a grid function `nodes`) and non-conforming ones.
MeshDocument read_mfem(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a mesh of two dimensions as FreeFem saves it, `bytes` being the whole of the file: the numbers of vertices,
/// triangles and edges; a line `x y label` for each vertex, `i j k label` for each triangle, `i j label` for each edge.
/// The edges become lines behind the triangles. Labels become the point and the cell array "freefem:label", where any
/// is not 0. Throws ReadError. Linear in the file's size.
MeshDocument read_freefem(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

/// Whether the first lines are those of such a file, and of no other.
bool begins_as_freefem(std::string_view bytes);

}  // namespace trismooth

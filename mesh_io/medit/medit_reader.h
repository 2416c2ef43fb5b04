// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a Medit file, `bytes` being the whole of it, text or binary, as its first bytes say. References become the
/// point and the cell array "medit:ref", where any is not 0. Corners, required vertices, and the vertices of ridges and
/// of required edges, triangles and quadrilaterals become point sets of these names. Throws ReadError. Linear in the
/// file's size.
MeshDocument read_medit(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

/// Whether the path has the extension of binary Medit files, .meshb in any case of letters, or that of text, .mesh;
/// nothing where it has neither.
std::optional<bool> names_binary_medit(const std::filesystem::path& path);

}  // namespace trismooth

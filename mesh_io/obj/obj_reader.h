// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an OBJ file, `bytes` being the whole of it. Faces (f), lines (l) and points (p) become cells in the file's
/// order; of their vertices only the position counts, texture and normal indices are merely checked to be whole
/// numbers. Indices may be negative (relative) and may refer to vertices that come later. `usemtl` and `g` number
/// the cells: int32 cell arrays "material" and "group", names in order of first appearance from 0, -1 before the
/// first; only where the file has such statements. Every other statement stays in the bytes that are written back,
/// and a note names it.
/// Throws ReadError for whatever breaks the rules, also for a file that is no OBJ file at all.
MeshDocument read_obj(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

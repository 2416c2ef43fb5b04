// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a MED file (2.3 to 4), `bytes` being the whole of it: of several meshes the first. Groups of elements become
/// the array med:group and sets of cells (see add_listed_groups), groups of nodes sets of points, fields at all nodes
/// point arrays; where a field has several steps, each is an array "name[number] - time". Written back, the bytes are
/// the same but for the coordinates and values that differ. Throws ReadError. Complexity: n log n in the file's size.
MeshDocument read_med(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

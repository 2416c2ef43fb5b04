// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a universal file. Throws ReadError.
MeshDocument read_unv(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a deck of Nastran, `bytes` being the whole of it, and the files that it includes. GRIDs become points and
/// elements cells, in the order of their cards. Properties become the int64 cell array "nastran:pid", with the names
/// that comments of preprocessors give them; nodes that constraints and loads name become sets of points. Throws
/// ReadError.
MeshDocument read_nastran(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

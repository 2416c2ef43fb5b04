// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes a document from scratch as text of version 4.1. Throws WriteError.
void write_msh(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// See Codec::what_is_lost.
std::vector<std::string> lost_in_msh(const MeshDocument& document);

}  // namespace trismooth

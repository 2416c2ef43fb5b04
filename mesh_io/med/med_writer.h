// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes the document as a MED file of version 3.0, which all later ones read, with groups as families: x and y alone
/// where all z are 0. Throws WriteError. Complexity: n log n in the members of groups and sets.
void write_med(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// What MED does not hold of it, one sentence each.
std::vector<std::string> lost_in_med(const MeshDocument& document);

}  // namespace trismooth

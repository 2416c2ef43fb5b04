// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes the triangles of the document as a Selafin file of double precision, with the most significant byte first, as
/// TELEMAC does: point arrays as variables of one step at time 0, the nodes of the boundary numbered along it, the
/// longest first. Throws WriteError. Complexity: n log n in the nodes of the boundary, else linear.
void write_selafin(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// What Selafin does not hold of it, one sentence each.
std::vector<std::string> lost_in_selafin(const MeshDocument& document);

}  // namespace trismooth

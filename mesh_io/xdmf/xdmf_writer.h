// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes a document as XDMF 3, one uniform grid, its numbers to the file that xdmf_other_files() names, or, where it
/// names none, into the text. Throws WriteError.
void write_xdmf(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// "mesh.h5" for "mesh.xdmf"; none for names of other endings (streams, compressed files), and in builds without HDF5.
std::vector<std::filesystem::path> xdmf_other_files(const std::filesystem::path& path);

/// What write_xdmf() leaves out, one sentence each.
std::vector<std::string> lost_in_xdmf(const MeshDocument& document);

}  // namespace trismooth

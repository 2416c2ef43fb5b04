// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/msh/msh_reader.h"

namespace trismooth {

/// Reads the file, whose original writes its bytes with the numbers of the document: coordinates, values of fields, and
/// the parametric coordinates of nodes that have moved. Where these are no affine map of the coordinates they are left
/// out for the nodes of that entity, which then are nodes without.
MeshDocument read_msh_file(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_content.h"
#include "trismooth/mesh_io/mesh_file.h"

namespace trismooth {

/// write_mesh() up to its last step, which is the commit of what this returns: for meshes to which other files belong.
WrittenAside write_mesh_aside(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added,
                              const FileOptions& options);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/medit/medit_mesh.h"

namespace trismooth {

/// The byte order of a Medit file that is binary; nothing for bytes that are not one: the number 1, a version from 1
/// to 4, and the code of the keyword Dimension, 32 bits each.
std::optional<NumberEncoding> medit_byte_order(std::string_view bytes);

/// Reads a Medit file that is binary (.meshb), as libMeshb writes it, `bytes` being the whole of it; it has a
/// medit_byte_order(). Version 1 has coordinates of float32, versions below 4 integers of 32 bits, versions below 3
/// positions of 32 bits. Throws ReadError, with the byte. Linear in the file's size.
MeditMesh read_medit_binary(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <filesystem>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The order of bytes of a file that begins as Selafin does: a title of 80 characters and two numbers of variables, as
/// records. Nothing where it does not.
std::optional<std::endian> selafin_byte_order(std::string_view bytes);

/// Reads a Selafin file of a plane mesh, `bytes` being the whole of it, in the order of bytes that it has: triangles or
/// quadrilaterals, and the variables of the last time step as point arrays under their names, with their units. Of a
/// file of one step, values follow the mesh where they are of the bottom. The numbers of nodes in the whole mesh, which
/// pieces of a parallel run have, are labels. Written back, the bytes are the same but for coordinates, and values of
/// one step, that differ. Throws ReadError. Complexity: linear.
MeshDocument read_selafin(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/off/off_keyword.h"

namespace trismooth {

/// Reads what follows the line "OFF BINARY" of an OFF file: `bytes`, the whole file, from `begin` on. Everything is a
/// 32-bit integer or a float32: the counts, the vertices, the faces. Geomview and CGAL write it in big-endian order and
/// each face with the number of its colour's components and these; OpenMesh and pmp-library write little-endian
/// order, and faces whose colours, three or four numbers or none, are not counted. The file does not say which: it is
/// the one in which the counts, the indices and the file's size fit together.
///
/// Fills everything but the original. Coordinates are float32; normals, colours and texture coordinates become arrays
/// as in text (colours int32 where all are whole numbers from 0 to 255 stored as integers).
/// Throws ReadError, with the byte. Linear in the file's size.
std::pair<MeshDocument, NumberSites> read_binary_off(const std::filesystem::path& path, std::string_view bytes,
                                                     std::size_t begin, const OffKeyword& keyword,
                                                     const FileWorkers& workers);

}  // namespace trismooth

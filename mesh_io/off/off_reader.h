// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/off/off_header.h"

namespace trismooth {

/// Reads an OFF file, `bytes` being the whole of it: Geomview's ASCII form with the keyword [ST][C][N]OFF in any case
/// (or none), comments, any line ends, and colours behind vertices and faces, declared or not; or binary (see
/// off_binary_reader.h). Triangles, quads and larger faces become cells in the file's
/// order. Normals, colours and texture coordinates become the point arrays "normals", "colours" and
/// "texture_coordinates", face colours the cell array "colours" where all faces have the same number of them.
/// Throws ReadError for homogeneous (4) and n-dimensional (n) files and for whatever breaks the rules; more
/// faces or vertices than the counts declare are refused too, since they mean that the counts are wrong.
/// Memory beside the result: none that grows with the file.
MeshDocument read_off(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

/// Reads some of the rows of an OFF text with that header, by the same rules: `rows` are lines of that many vertices,
/// the file's last vertices where faces follow, then of that many faces, whose corners are numbers in the whole file.
/// Without an original. Throws ReadError, whose line is that in `rows`, and where anything stands behind them.
MeshDocument read_off_rows(const std::filesystem::path& path, std::string_view rows, const OffHeader& header,
                           std::size_t vertices, std::size_t faces, const FileWorkers& workers);

}  // namespace trismooth

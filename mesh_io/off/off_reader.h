#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

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

}  // namespace trismooth

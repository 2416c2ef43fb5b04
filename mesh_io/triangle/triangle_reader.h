// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// One of the two files of a mesh of Triangle.
struct TriangleFile {
  std::filesystem::path path;
  FileBytes bytes;
};

/// Reads the mesh that the files hold: nodes and elements counted from 0 or 1, comments with '#', any line ends.
/// Attributes of nodes become the point array "triangle:attribute" with as many components, boundary markers
/// "triangle:marker". Of the elements' attributes the last one, which the switch -A makes the region, becomes the cell
/// array "triangle:attribute", of whole numbers where all of them are; those before it "triangle:attribute_1", ... The
/// six nodes of a quadratic triangle come in VTK's order. Writing back writes the file that the path's extension names.
/// Throws ReadError for whatever breaks the rules; more rows than the counts declare too.
MeshDocument read_triangle_files(TriangleFile nodes, TriangleFile elements, const FileWorkers& workers);

/// read_triangle_files() of the file at `path`, whose bytes are `bytes`, and its partner beside it. Throws ReadError,
/// also where that is missing.
MeshDocument read_triangle(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a PLY file (version 1.0; ASCII, little-endian, big-endian), whose bytes are `bytes`.
///
/// Element vertex gives the points (x, y, z: float or double), its other scalar properties point arrays of their names
/// and types. Element face gives the triangles, quads and polygons (list vertex_indices or vertex_index), element edge
/// the lines (vertex1, vertex2), element tristrips the triangle strips (the same list, -1 between two), in the order of
/// the file. The other scalar properties of faces and edges give cell arrays, whose rows are 0 for the element that
/// lacks the property. All else, and what follows the last row, is kept in the original's bytes and named in the notes.
/// The types int64 and uint64, which PLY lacks, are read. Where x, y and z are not of one type, point_type is float64,
/// and has_float32_axis is set.
///
/// Throws ReadError where the file breaks the format's rules, and for coordinates of an integer type, faces and
/// strips of less than three vertices, and where another row follows those that the header declares. Linear in the
/// file's size.
MeshDocument read_ply(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

/// Writes the document as little-endian PLY: double coordinates (float where point_type is float32), faces, then
/// lines as element edge, and every point and cell array as scalar properties. Throws WriteError.
void write_ply(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// What write_ply leaves out or changes, one sentence each.
std::vector<std::string> what_ply_loses(const MeshDocument& document);

}  // namespace trismooth

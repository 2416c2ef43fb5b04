// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a native mesh of SU2, `bytes` being the whole of it: sections in any order, comments with '%', blanks around
/// '=' or none, any line ends, indices behind points and elements or none.
///
/// All zones become one document: points and cells zone by zone, and the cell array "su2:zone" with the zones' numbers,
/// where the file has zones. Points of different zones are never the same point, even where they coincide. Cells
/// stand in the file's order, those of elements and of markers. The cell array "su2:marker" numbers the markers
/// from 1 in the file's order (elements have 0), with their names. Markers of one name have one number, in several
/// zones too: it is by its name that SU2's configuration knows a marker, and groups of other formats are known by it.
///
/// Meshes of three dimensions are read where they hold faces alone. Throws ReadError for solids, and for whatever
/// breaks the rules: more rows than the counts declare too, since they mean that the counts are wrong.
/// Memory beside the result: none that grows with the file.
MeshDocument read_su2(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

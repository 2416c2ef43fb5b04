// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an STL file (ASCII or binary), whose bytes are `bytes`. It is binary where its size is that of its number of
/// facets, whatever its first word is, or larger and no text: bytes behind the last facet are kept and noted, unless
/// they begin with another facet. Text may begin with a byte-order mark and end without 'endsolid'; lines that begin
/// with a word that STL does not know, such as 'color', are kept and noted.
///
/// Corners of equal coordinates become one point, numbered in the order of the file; a moved point is written back at
/// all its corners. ASCII coordinates are float64, binary ones float32. Several ASCII solids give the int32 cell array
/// "solid" (numbers from 0), binary attribute words other than 0 the uint16 cell array "attribute". Normals are kept
/// in the original's bytes as they are.
///
/// Throws ReadError where the file breaks the format's rules. Linear in the file's size.
MeshDocument read_stl(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

/// Writes the document's triangles as one solid of ASCII STL (binary STL would round coordinates to float32), in the
/// shortest texts that read back to the same float64, each with its unit normal, which is 0 0 0 for a degenerate
/// triangle. Throws WriteError.
void write_stl(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// Whether the bytes are those of an STL file: as many as the number of facets in them asks for, or a text with a solid
/// and its facets.
bool is_stl(std::string_view bytes);

/// What write_stl leaves out or changes, one sentence each.
std::vector<std::string> what_stl_loses(const MeshDocument& document);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a CGNS file that is kept in HDF5, `bytes` being the whole of it: the
/// unstructured zones of its first base, one behind the other. Boundary
/// conditions of elements become the array cgns:group and sets of cells (see
/// add_listed_groups) under the names of their families, or their own; several
/// zones are groups of the cells of the base's dimension; conditions at nodes
/// become sets of points, and solutions at the nodes of all zones point arrays.
/// Points that zones or periods have in common are an implied set. Written
/// back, the bytes are the same but for the coordinates and values that differ.
/// Throws ReadError. Complexity: n log n in the file's size.
MeshDocument read_cgns(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

/// Whether the file is CGNS in the older form, ADF, which is refused.
bool is_adf(std::string_view bytes);

}  // namespace trismooth

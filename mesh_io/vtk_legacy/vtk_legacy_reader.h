// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_layout.h"

namespace trismooth {

/// Reads the bytes of a legacy VTK file (versions 1.0 to 5.1, ASCII and BINARY, UNSTRUCTURED_GRID and POLYDATA) into a
/// document without an original, and fills its layout. Throws ReadError with the line or byte offset; `path` is for
/// messages. The cells of a POLYDATA come in VTK's order (vertices, lines, polygons, strips), which is that of its
/// cell data, whatever the order of the sections.
MeshDocument read_vtk_legacy(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers,
                             VtkLegacyLayout& layout);

}  // namespace trismooth

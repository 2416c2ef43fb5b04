// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

/// Lays a mesh whose x is longitude and whose y is latitude, in degrees, onto the map on which it is smoothed (see
/// GeographicMap). Triangles in which longitudes are not continuous, as where a mesh goes round the globe, are kept as
/// they are, as other cells are, and their vertices held: a note says so. Throws ReadError naming `path` for a mesh
/// that does not lie in the plane of x and y, and for vertices of cells that are no such numbers or at a pole.
void lay_on_map(PlanarMesh& mesh, const MeshDocument& document, const std::filesystem::path& path);

/// Throws ReadError naming `path` for vertices of cells of the document, which has those of the mesh, that are no
/// longitudes and latitudes, or at a pole.
void require_degrees(const PlanarMesh& mesh, const MeshDocument& document, const std::filesystem::path& path);

/// Whether x and y could well be longitude and latitude in degrees: the file says so, or it is of one of the formats
/// that hold such ones, with coordinates in their range and an extent of more than 3.
bool looks_geographic(const PlanarMesh& mesh, const MeshDocument& document);

/// What the user should know of it then.
inline constexpr std::string_view looks_geographic_note =
    "x and y look like longitude and latitude in degrees: --geographic smooths shapes as they are on the sphere";

}  // namespace trismooth

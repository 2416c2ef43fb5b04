#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/plane.h"
#include "trismooth/quality/point2.h"
#include "trismooth/quality/triangle_view.h"

namespace trismooth {

/// The planar triangle mesh that a document holds.
struct PlanarMesh {
  Plane plane;
  std::vector<Point2<double>> points;       ///< every vertex of the document in coordinates of the plane, file units
  std::vector<Triangle> triangles;          ///< in the document's order, each in the document's vertex order
  std::vector<std::int32_t> cells;          ///< the document's cell of each triangle
  std::vector<std::uint8_t> in_other_cell;  ///< per vertex: 1 where a cell that is not a triangle uses it
  std::int64_t other_cells = 0;             ///< cells that are not triangles
  std::vector<std::string> notes;           ///< what the user should know, one sentence each
};

/// Finds the triangles and the plane of the document. A triangle that repeats a vertex counts as another cell: it is
/// kept, its vertices are held, and a note says so. Throws ReadError naming `path` where the points do not lie in one
/// plane (within 1e-6 of their extent) or have no finite coordinates in it (near the largest double), or the document
/// holds cells but no triangle. A document without any cell is fine: nothing to smooth. Complexity: linear.
PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path);

/// The vertex numbers (from 0, separated by white space, '#' comments) of a text file. Throws ReadError, also for a
/// number that is not below `vertex_count`.
std::vector<std::int32_t> read_vertex_ids(const std::filesystem::path& path, std::int64_t vertex_count);

}  // namespace trismooth

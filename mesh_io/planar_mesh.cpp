#include "trismooth/mesh_io/planar_mesh.h"

#include <cmath>
#include <limits>
#include <span>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

bool is_triangle(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return vertices.size() == 3 && (type == cell_type::triangle || type == cell_type::polygon);
}

bool repeats_a_vertex(std::span<const std::int32_t> triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void sort_cells(const MeshDocument& document, PlanarMesh& mesh) {
  std::int64_t degenerate = 0;
  std::size_t first_degenerate = 0;
  mesh.in_other_cell.assign(document.point_count(), 0);
  mesh.triangles.reserve(document.cells.size());
  mesh.cells.reserve(document.cells.size());
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const auto vertices = document.cells[c];
    const bool triangular = is_triangle(document.cells.types[c], vertices);
    if (triangular && !repeats_a_vertex(vertices)) {
      mesh.triangles.push_back({vertices[0], vertices[1], vertices[2]});
      mesh.cells.push_back(static_cast<std::int32_t>(c));
      continue;
    }
    if (triangular && degenerate++ == 0) {
      first_degenerate = c;
    }
    ++mesh.other_cells;
    for (const std::int32_t v : vertices) {
      mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
    }
  }
  if (degenerate > 0) {
    mesh.notes.push_back(counted(degenerate, "triangle") + " repeating a vertex (the first is cell " +
                         std::to_string(first_degenerate) + "): kept as they are, their vertices held fixed");
  }
  if (mesh.other_cells > degenerate) {
    mesh.notes.push_back(counted(mesh.other_cells - degenerate, "cell") +
                         " of other types than triangle: kept as they are, their vertices held fixed");
  }
}

}  // namespace

PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path) {
  if (document.point_count() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw ReadError(path, "holds more than 2147483647 vertices");
  }
  PlanarMesh mesh;
  sort_cells(document, mesh);
  if (mesh.triangles.empty() && document.cells.size() > 0) {
    throw ReadError(path, "holds " + counted(static_cast<std::int64_t>(document.cells.size()), "cell") +
                              " but no triangle; only triangle meshes can be smoothed");
  }
  if (mesh.triangles.empty()) {
    mesh.notes.emplace_back("the file holds no cells: nothing to smooth");
  }
  const auto plane = fit_plane(document.points);
  if (!plane) {
    throw ReadError(path,
                    "the mesh is not planar: its points leave every plane by more than 1e-6 of its extent; "
                    "only planar meshes can be smoothed");
  }
  mesh.plane = *plane;
  mesh.points.resize(document.point_count());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    mesh.points[v] = plane->project(Eigen::Map<const Eigen::Vector3d>(document.points.data() + 3 * v));
    if (!std::isfinite(mesh.points[v].x) || !std::isfinite(mesh.points[v].y)) {
      throw ReadError(path,
                      "the mesh is too large: coordinates along its tilted plane are beyond the range of double; "
                      "scale it down");
    }
  }
  return mesh;
}

}  // namespace trismooth

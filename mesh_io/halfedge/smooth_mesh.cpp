#include "trismooth/mesh_io/halfedge/smooth_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/errors.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/workers.h"
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"
#include "trismooth/mesh_io/halfedge/plane_smoothing.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/invalid_triangles.h"

namespace trismooth {

namespace {

void require_no_deleted_elements(const TriangleMesh& mesh) {
  const bool vertices = mesh.has_vertex_status() && std::ranges::any_of(mesh.all_vertices(), [&](auto v) {
                          return mesh.status(OpenMesh::VertexHandle(v.idx())).deleted();
                        });
  const bool faces = mesh.has_face_status() && std::ranges::any_of(mesh.all_faces(), [&](auto f) {
                       return mesh.status(OpenMesh::FaceHandle(f.idx())).deleted();
                     });
  if (vertices || faces) {
    throw std::invalid_argument("the mesh has deleted elements; call garbage_collection() first");
  }
}

/// One flag a vertex. Flags of a wrong length are refused later, with the other constraints.
std::vector<std::uint8_t> used_vertices(std::size_t count, std::span<const Triangle> triangles,
                                        std::span<const std::uint8_t> other_cells) {
  std::vector<std::uint8_t> used(count, 0);
  for (const Triangle& t : triangles) {
    for (const std::int32_t v : t) {
      used[static_cast<std::size_t>(v)] = 1;
    }
  }
  for (std::size_t v = 0; v < std::min(count, other_cells.size()); ++v) {
    used[v] |= other_cells[v] != 0 ? std::uint8_t{1} : std::uint8_t{0};
  }
  return used;
}

CellList cells_of(std::span<const Triangle> triangles) {
  CellList cells;
  for (const Triangle& t : triangles) {
    cells.append(cell_type::triangle, t);
  }
  return cells;
}

/// A mesh laid into a plane.
struct InPlane {
  Plane plane;
  BulkVector<Point2<double>> points;
  LocalPoints local;

  InPlane(const PlaneFit& fit, std::span<const double> xyz, std::span<const std::uint8_t> in_cell) : plane(fit.plane) {
    if (!fit.is_planar()) {
      throw MeshError(fit.fault());
    }
    Workers one(1);
    auto projected = project(plane, xyz, in_cell, one);
    if (!projected) {
      throw MeshError("the mesh is too large: coordinates along its tilted plane are beyond the range of double");
    }
    points = *std::move(projected);
    local = entered(local_frame(points, [&](std::size_t v) { return in_cell[v] != 0; }), points);
  }
};

}  // namespace

SmoothingResult smooth(TriangleMesh& mesh, const Constraints& constraints, const SmoothingOptions& options) {
  options.validate();
  require_no_deleted_elements(mesh);
  std::vector<double> xyz(3 * mesh.n_vertices());
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
    Eigen::Map<Eigen::Vector3d>(xyz.data() + 3 * v) = mesh.point(OpenMesh::VertexHandle(static_cast<int>(v)));
  }
  if (!std::ranges::all_of(xyz, [](double x) { return std::isfinite(x); })) {
    throw MeshError("the mesh has a coordinate that is not finite");
  }
  const std::vector<Triangle> triangles = face_list(mesh);
  const std::vector<std::uint8_t> in_cell = used_vertices(xyz.size() / 3, triangles, constraints.other_cells);
  InPlane placed(fit_plane(xyz, in_cell, cells_of(triangles)), xyz, in_cell);

  Workers workers(options.threads);
  MeshRings found = rings_for(options, placed.local.points, triangles, constraints, [&] {
    return find_mesh_rings(placed.local.points, triangles, constraints, workers, options.used_layers());
  });
  if (const auto fit = plane_of_fixed(placed.plane, xyz, in_cell, found.fixed)) {
    placed = InPlane(*fit, xyz, in_cell);
  }
  SmoothingResult result =
      smooth_in_plane(found, triangles, placed.plane, xyz, placed.points, placed.local, Storage::float64, options);
  result.layers = found.layers;
  result.backend_note = joined_notes(found.note, result.backend_note);
  count_invalid(
      triangles, found.reversed, [&](std::int32_t v) { return placed.local.frame.enter(placed.points[v]); }, workers,
      result);
  for (std::size_t v = 0; v < placed.points.size(); ++v) {
    mesh.set_point(OpenMesh::VertexHandle(static_cast<int>(v)), Eigen::Map<const Eigen::Vector3d>(xyz.data() + 3 * v));
  }
  return result;
}

SmoothingResult smooth(TriangleMesh& mesh, const SmoothingOptions& options) {
  return smooth(mesh, {}, options);
}

}  // namespace trismooth

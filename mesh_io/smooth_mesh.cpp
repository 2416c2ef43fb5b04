#include "trismooth/mesh_io/smooth_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "trismooth/mesh_io/halfedge_mesh.h"
#include "trismooth/mesh_io/plane_smoothing.h"
#include "trismooth/quality/local_frame.h"
#include "trismooth/smoothing/errors.h"

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
  const auto plane = fit_plane(xyz);
  if (!plane) {
    throw MeshError("the mesh is not planar: its points leave every plane by more than 1e-6 of its extent");
  }
  std::vector<Point2<double>> points(mesh.n_vertices());
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v] = plane->project(Eigen::Map<const Eigen::Vector3d>(xyz.data() + 3 * v));
    if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y)) {
      throw MeshError("the mesh is too large: coordinates along its tilted plane are beyond the range of double");
    }
  }
  const LocalFrame frame = local_frame(points);
  std::vector<Point2<double>> local(points.size());
  std::ranges::transform(points, local.begin(), [&](Point2<double> p) { return frame.enter(p); });

  Workers workers(options.threads);
  const std::vector<Triangle> triangles = face_list(mesh);
  const MeshRings found = rings_for(options, local, triangles, constraints, workers,
                                    [&](const TriangleTopology& /*topology*/, const MeshRings& known) {
                                      return one_rings(mesh, known.fixed, known.reversed, workers);
                                    });
  const double fixed_quotient = smallest_fixed_quotient(local, triangles, found.reversed, found.fixed);
  SmoothingResult result =
      smooth_in_plane(found.rings, *plane, xyz, points, local, fixed_quotient, Storage::float64, options);
  for (std::size_t v = 0; v < points.size(); ++v) {
    mesh.set_point(OpenMesh::VertexHandle(static_cast<int>(v)), Eigen::Map<const Eigen::Vector3d>(xyz.data() + 3 * v));
  }
  return result;
}

SmoothingResult smooth(TriangleMesh& mesh, const SmoothingOptions& options) {
  return smooth(mesh, {}, options);
}

}  // namespace trismooth

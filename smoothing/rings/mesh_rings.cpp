#include "trismooth/smoothing/rings/mesh_rings.h"

#include <utility>

#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"

namespace trismooth {

MeshRings find_mesh_rings(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                          const Constraints& constraints, Workers& workers) {
  check_mesh_size(std::ssize(points), std::ssize(triangles));
  const TriangleTopology topology = connect_triangles(static_cast<std::int32_t>(points.size()), triangles, workers);
  Orientation orientation = orient(topology, triangles, points);
  MeshRings found;
  found.fixed = fixed_vertices(topology, triangles, constraints);
  found.reversed = std::move(orientation.reversed);
  found.components = topology.components;
  found.reoriented_triangles = orientation.reoriented_triangles;
  found.rings = one_rings(topology, triangles, found.reversed, found.fixed, workers);
  return found;
}

}  // namespace trismooth

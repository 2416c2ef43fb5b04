#include "trismooth/smoothing/rings/mesh_rings.h"

#include <utility>

#include "trismooth/base/mesh_size.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/layers/layers.h"
#include "trismooth/smoothing/rings/mesh_connectivity.h"

namespace trismooth {

MeshRings with_rings_of(MeshRings& mesh) {
  OneRings rings = std::exchange(mesh.rings, {});
  MeshRings copy = mesh;
  copy.rings = std::move(rings);
  return copy;
}

MeshRings find_mesh_rings(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                          const Constraints& constraints, Workers& workers, Layers layers) {
  check_mesh_size(std::ssize(points), std::ssize(triangles));
  MeshConnectivity connectivity(static_cast<std::int32_t>(points.size()), triangles, workers);
  Orientation orientation = orient(connectivity.components(), triangles, points, workers);
  MeshRings found;
  found.fixed = connectivity.fixed_vertices(triangles, constraints, workers);
  found.layers = hold_layers(points, triangles, orientation.reversed, layers, constraints.slide.along != Slide::off,
                             found.fixed, workers);
  found.slidable = find_slidable(triangles, found.fixed, constraints, workers);
  found.reversed = std::move(orientation.reversed);
  found.components = connectivity.components().components;
  found.reoriented_triangles = orientation.reoriented_triangles;
  found.rings = std::move(connectivity).one_rings(triangles, found.reversed, found.fixed, workers);
  return found;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/mesh_rings.h"

#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/smoothing/rings/analysed_mesh.h"

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
  AnalysedMesh mesh(static_cast<std::int32_t>(points.size()), triangles, constraints, workers);
  mesh.look_at(points, triangles, layers, workers);
  return std::move(mesh).with_rings(triangles, workers);
}

}  // namespace trismooth

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

MeshRings find_mesh_rings(std::span<const Point2<double>> points, const ElementList& elements,
                          const Constraints& constraints, Workers& workers, Layers layers) {
  check_mesh_size(std::ssize(points), static_cast<std::int64_t>(elements.size()), elements.are_triangles() ? 3 : 4);
  return elements.visit([&](const auto& listed) {
    AnalysedMesh mesh(static_cast<std::int32_t>(points.size()), listed, constraints, workers);
    mesh.look_at(points, listed, layers, workers);
    return std::move(mesh).with_rings(listed, workers);
  });
}

}  // namespace trismooth

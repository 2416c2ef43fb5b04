// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/kept_constraints.h"
#include "trismooth/smoothing/rings/mesh_connectivity.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

class Workers;

/// A mesh whose connectivity is analysed once, on the host, whatever its coordinates are by then. Owns all it needs but
/// the elements, which are handed in and are the same in every call.
class AnalysedMesh {
 public:
  /// Throws as connect_triangles() and fixed_vertices() do. Complexity: linear.
  AnalysedMesh(std::int32_t vertex_count, const ElementList& elements, const Constraints& constraints,
               Workers& workers);

  /// Why each vertex is held, bits of namespace hold; layers are among them when points have been looked at.
  const std::vector<std::uint8_t>& fixed() const { return mesh_.fixed; }
  /// Per element, as the last points have it: see MeshRings.
  const std::vector<std::uint8_t>& reversed() const { return mesh_.reversed; }
  /// What was held since it is flat on purpose in the first points.
  const LayersResult& layers() const { return mesh_.layers; }

  /// Orients the components as these points in the local frame have them; the first points also say what is a layer and
  /// what may slide. True where the orientation is a new one. Complexity: linear.
  bool look_at(std::span<const Point2<double>> local, const ElementList& elements, Layers layers, Workers& workers);

  /// The rings of the vertices that `held` leaves free, after points have been looked at. Complexity: linear.
  OneRings rings_of(std::span<const std::uint8_t> held, const ElementList& elements, Workers& workers) const {
    return elements.visit(
        [&](const auto& listed) { return connectivity_.one_rings(listed, mesh_.reversed, held, workers); });
  }

  /// All that is known, after points have been looked at. Complexity: linear.
  MeshRings with_rings(const ElementList& elements, Workers& workers) const& {
    MeshRings copy = mesh_;
    copy.rings = rings_of(mesh_.fixed, elements, workers);
    return copy;
  }
  /// All that is known, for the last time: the memory of it goes into the result.
  MeshRings with_rings(const ElementList& elements, Workers& workers) && {
    mesh_.rings = elements.visit([&](const auto& listed) {
      return std::move(connectivity_).one_rings(listed, mesh_.reversed, mesh_.fixed, workers);
    });
    return std::move(mesh_);
  }

 private:
  MeshConnectivity connectivity_;
  MeshRings mesh_;  ///< but for the rings
  bool has_found_layers_ = false;
  /// What constraints say of sliding, until what may slide is found: when layers are known, from the first points.
  std::optional<KeptConstraints> slide_;
};

}  // namespace trismooth

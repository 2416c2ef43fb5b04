// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/moving/carry.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/systems/graph_laplacian.h"

namespace trismooth {

/// How what is held has moved.
struct HeldMotion {
  RigidMotion all;                    ///< on average
  std::vector<Point2<double>> turns;  ///< of each vertex of Carrier::held(), as complex numbers of length 1
};

/// What it takes for carry() to take the free vertices of a mesh along with the held ones. What is near a held edge
/// turns as that does, and the turns die away smoothly; then each edge is to be what it was, turned so (Y. Yu et al.:
/// Mesh editing with Poisson-based gradient field manipulation, 2004). A mesh that is moved as a rigid body comes out
/// as one, layers keep their height on a wall that turns, and short edges are stiff: each counts by 1 / length^2. Two
/// linear systems, whose matrix is that of the mesh it was made of.
class Carrier {
 public:
  /// Of no mesh.
  Carrier() = default;
  /// `rings`: of the free vertices, in the numbering of the points; `points`: in any frame. Complexity: linear, but for
  /// sorting the held vertices.
  Carrier(const RingView& rings, const ElementList& elements, std::span<const Point2<double>> points);

  /// Those that are carried, ascending: the free vertices that hang together with a held one.
  const std::vector<std::int32_t>& carried() const { return carried_; }

  /// The held vertices whose motion counts, ascending: those of held edges, and those beside a carried one.
  const std::vector<std::int32_t>& held() const { return held_; }

  /// The edges between held vertices, each once, ascending, by their places in held().
  const std::vector<std::array<std::int32_t, 2>>& edges() const { return edges_; }

  const GraphLaplacian& laplacian() const { return laplacian_; }
  const std::vector<std::int64_t>& held_offsets() const { return held_offsets_; }
  const std::vector<HeldLink>& held_links() const { return held_links_; }
  double held_weight() const { return held_weight_; }

  /// `from`, `now`: where each vertex of held() was and is. Complexity: linear in these.
  HeldMotion motion_of_held(std::span<const Point2<double>> from, std::span<const Point2<double>> now) const;

  /// All in memory of the host. `levels`: laplacian().view().
  CarryView view(std::span<const LevelView> levels) const {
    return {levels, carried_.data(), held_.data(), held_offsets_.data(), held_links_.data(), held_weight_};
  }

 private:
  std::vector<std::int32_t> carried_;
  std::vector<std::int32_t> held_;
  std::vector<std::array<std::int32_t, 2>> edges_;
  std::vector<std::int64_t> held_offsets_{0};
  std::vector<HeldLink> held_links_;
  double held_weight_ = 0;
  GraphLaplacian laplacian_;  ///< of the carried vertices
};

}  // namespace trismooth

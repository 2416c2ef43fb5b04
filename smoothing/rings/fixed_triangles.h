// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"

namespace trismooth {

/// The triangles without a free vertex. No sweep sees them, and none changes them; but they count for the smallest
/// shape of the mesh, so a quality target above theirs is never reached.
class FixedTriangles {
 public:
  /// None.
  FixedTriangles() = default;

  /// Those of a mesh. `reversed`: one flag a triangle, as Orientation::reversed; `fixed`: one byte a vertex, 0 is free.
  /// `ghosts`: as MeshPart::ghosts, where it is a part of another mesh: then those whose first vertex it owns, so that
  /// each is in one part. Complexity: linear.
  FixedTriangles(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                 std::span<const std::uint8_t> fixed, Workers& workers, std::span<const std::uint8_t> ghosts = {}) {
    // Memory that is never touched costs nothing.
    corners_.resize(triangles.size());
    const std::int64_t count = for_each_numbered(
        std::ssize(triangles),
        [&](std::int64_t t) {
          const Triangle& corners = triangles[static_cast<std::size_t>(t)];
          return all_are_fixed(corners, fixed) && (ghosts.empty() || ghosts[std::ranges::min(corners)] == 0);
        },
        [&](std::int64_t number, std::int64_t t) {
          corners_[static_cast<std::size_t>(number)] =
              canonical_corners(triangles[static_cast<std::size_t>(t)], reversed[static_cast<std::size_t>(t)] != 0);
        },
        workers);
    corners_.resize(static_cast<std::size_t>(count));
  }

  /// Their smallest shape quotient, where position(v) is vertex v in the local frame; infinite where there is none.
  template <class Position>
  double smallest_quotient(const Position& position) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Triangle& corners : corners_) {
      smallest = std::min(smallest, shape_quotient(points_of(corners, position)));
    }
    return smallest;
  }

  /// How many of them are inverted or degenerate, where position(v) is vertex v in the local frame.
  template <class Position>
  std::int64_t inverted(const Position& position) const {
    return std::ranges::count_if(
        corners_, [&](const Triangle& corners) { return !(shape_quotient(points_of(corners, position)) > 0); });
  }

 private:
  BulkVector<Triangle> corners_;  ///< in canonical order
};

}  // namespace trismooth

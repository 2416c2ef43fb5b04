#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

/// The triangles without a free vertex. No sweep sees them, and none changes them; but they count for the smallest
/// shape of the mesh, so a quality target above theirs is never reached.
class FixedTriangles {
 public:
  /// None.
  FixedTriangles() = default;

  /// Those of a mesh. `reversed`: one flag a triangle, as Orientation::reversed; `fixed`: one byte a vertex, 0 is free.
  /// Complexity: linear.
  FixedTriangles(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                 std::span<const std::uint8_t> fixed) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      if (fixed[a] != 0 && fixed[b] != 0 && fixed[c] != 0) {
        corners_.push_back(canonical_corners(triangles[t], reversed[t] != 0));
      }
    }
  }

  /// Their smallest shape quotient, where position(v) is vertex v in the local frame; infinite where there is none.
  template <class Position>
  double smallest_quotient(const Position& position) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : corners_) {
      smallest = std::min(smallest, shape_quotient(position(a), position(b), position(c)));
    }
    return smallest;
  }

  /// How many of them are inverted or degenerate, likewise.
  template <class Position>
  std::int64_t inverted(const Position& position) const {
    return std::ranges::count_if(corners_, [&](const Triangle& triangle) {
      const auto [a, b, c] = triangle;
      return !(shape_quotient(position(a), position(b), position(c)) > 0);
    });
  }

 private:
  std::vector<Triangle> corners_;  ///< in canonical order
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// The orientation of every triangle.
struct Orientation {
  std::vector<std::uint8_t> reversed;     ///< 1 where the triangle is listed clockwise in the consistent orientation
  std::int64_t reoriented_triangles = 0;  ///< listed against the majority of their component
};

/// What the triangles of a component say of its orientation, against that of its lowest triangle. Sums and a minimum:
/// their order does not matter.
struct OrientationVotes {
  static constexpr std::int64_t nobody = std::numeric_limits<std::int64_t>::max();

  std::int64_t positive = 0;
  std::int64_t negative = 0;
  std::int64_t first = nobody;  ///< 2 t for the lowest-numbered triangle t that has a sign, + 1 where it is negative
  std::int64_t triangles = 0;
  std::int64_t against = 0;  ///< listed against the lowest triangle

  /// Whether the component is to be oriented against its lowest triangle.
  [[nodiscard]] bool flip() const {
    return negative != positive ? negative > positive : first != nobody && first % 2 != 0;
  }
  /// Those listed against the majority.
  [[nodiscard]] std::int64_t reoriented_triangles() const { return std::min(against, triangles - against); }
};

/// The votes of every component. `left_out`: one flag a triangle, of those that have none; empty: all have one.
/// `points` are in the local frame. Complexity: linear.
std::vector<OrientationVotes> orientation_votes(const TriangleComponents& components,
                                                std::span<const Triangle> triangles,
                                                std::span<const Point2<double>> points,
                                                std::span<const std::uint8_t> left_out, Workers& workers);
/// The votes of every component where quadrilaterals are among the elements: of one its area has the sign.
std::vector<OrientationVotes> orientation_votes(const TriangleComponents& components,
                                                std::span<const MixedElement> elements,
                                                std::span<const Point2<double>> points,
                                                std::span<const std::uint8_t> left_out, Workers& workers);

/// Each component is oriented so that the majority of its triangles is positive; a tie makes its lowest-numbered
/// non-degenerate triangle positive. `points` are in the local frame, so that no product overflows. Complexity: linear.
Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points, Workers& workers);
Orientation orient(const TriangleComponents& components, std::span<const MixedElement> elements,
                   std::span<const Point2<double>> points, Workers& workers);

/// orient() on the calling thread.
Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points);

}  // namespace trismooth

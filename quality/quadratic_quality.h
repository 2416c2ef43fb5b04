// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/base/element_list.h"
#include "trismooth/quality/quadratic_triangle.h"

namespace trismooth {

/// A triangle of the mesh that has a node in the middle of each side.
struct QuadraticTriangle {
  std::int32_t triangle = 0;            ///< its corners, by its place among the elements
  std::array<std::int32_t, 3> middles;  ///< of the sides 01, 12 and 20, as the triangle is listed
};

/// How valid the quadratic triangles of a mesh are: see quadratic_triangle.h.
struct QuadraticQuality {
  std::int64_t elements = 0;
  std::int64_t invalid = 0;  ///< those whose J is somewhere below 0, or whose corners enclose no area
  /// The smallest J by that of the straight triangle; minus infinity where one has no area, infinity of none.
  double min_jacobian = 0;
  std::int64_t undecided = 0;  ///< those whose smallest J is 0 to rounding: neither valid nor invalid
};

/// The nodes of a quadratic triangle, counter-clockwise in the orientation that `is_reversed` says of its triangle.
inline QuadraticNodes quadratic_nodes(std::span<const std::int32_t> corners, const std::array<std::int32_t, 3>& middles,
                                      bool is_reversed, std::span<const Point2<double>> points) {
  const auto at = [points](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
  return is_reversed ? QuadraticNodes{at(corners[0]), at(corners[2]), at(corners[1]),
                                      at(middles[2]), at(middles[1]), at(middles[0])}
                     : QuadraticNodes{at(corners[0]), at(corners[1]), at(corners[2]),
                                      at(middles[0]), at(middles[1]), at(middles[2])};
}

/// How valid `elements` are, triangles of the view with their middles, which are among its points. `threads`: 0 for
/// all; the same bits for every number of them. Throws std::invalid_argument for a wrong one. Complexity: linear.
[[nodiscard]] QuadraticQuality quadratic_quality(const MeshView& view, std::span<const QuadraticTriangle> elements,
                                                 int threads = 0);

}  // namespace trismooth

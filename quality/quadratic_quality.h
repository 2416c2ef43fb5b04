// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "trismooth/base/element_list.h"
#include "trismooth/quality/jacobian_bound.h"

namespace trismooth {

/// An element of the mesh that has a node in the middle of each side: a triangle of six nodes, a quadrilateral of eight
/// or of nine.
struct QuadraticElement {
  std::int32_t element = 0;  ///< its corners, by its place among the elements
  /// Of the sides 01, 12, ... as the element is listed, then the centre of a quadrilateral of nine nodes, then
  /// no_corner.
  std::array<std::int32_t, 5> middles;

  /// The node in the centre, or no_corner.
  std::int32_t centre() const { return middles[4]; }
};

/// How valid the quadratic elements of a mesh are: see jacobian_bound.h.
struct QuadraticQuality {
  std::int64_t elements = 0;
  std::int64_t quadrilaterals = 0;  ///< those of them that are
  std::int64_t invalid = 0;         ///< those whose J is somewhere below 0, or whose corners enclose no area
  /// The smallest J by the mean that it has with straight sides; minus infinity where an element has no area, infinity
  /// of none.
  double min_jacobian = 0;
  std::int64_t undecided = 0;  ///< those whose smallest J is 0 to rounding: neither valid nor invalid
};

/// The smallest J of a quadratic element with these corners, in the orientation that `is_reversed` says of it.
/// `points`: all nodes. Constant time: see jacobian_bound() in quadratic_triangle.h and quadratic_quadrilateral.h.
JacobianBound jacobian_bound(const QuadraticElement& element, std::span<const std::int32_t> corners, bool is_reversed,
                             std::span<const Point2<double>> points);

/// What the elements are called, one and several.
[[nodiscard]] std::pair<std::string_view, std::string_view> quadratic_words(const QuadraticQuality& found);

/// How valid `elements` are, those of the view with their middles, which are among its points. `threads`: 0 for
/// all; the same bits for every number of them. Throws std::invalid_argument for a wrong one. Complexity: linear.
[[nodiscard]] QuadraticQuality quadratic_quality(const MeshView& view, std::span<const QuadraticElement> elements,
                                                 int threads = 0);

}  // namespace trismooth

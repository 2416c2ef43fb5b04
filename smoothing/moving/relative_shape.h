// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/follow_result.h"

namespace trismooth {

/// The mean ratio of the map from one triangle to another, which are oriented alike: 2 det / |.|^2. The square of its
/// norm is that of the edges of the other, weighted by the cotangents of the angles that face them in the first. NaN
/// where the first is not valid.
constexpr TRISMOOTH_HOST_DEVICE double relative_shape(const std::array<Point2<double>, 3>& from,
                                                      const std::array<Point2<double>, 3>& to) {
  const auto dot = [](Point2<double> a, Point2<double> b) { return a.x * b.x + a.y * b.y; };
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point2<double> edge = to[(i + 2) % 3] - to[(i + 1) % 3];
    squares += dot(from[(i + 1) % 3] - from[i], from[(i + 2) % 3] - from[i]) * dot(edge, edge);
  }
  const double area = cross(from[1] - from[0], from[2] - from[0]);  // doubled: what makes cotangents of the products
  if (!(area > 0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return squares > 0 ? 2 * cross(to[1] - to[0], to[2] - to[0]) * area / squares : 0;  // 0: all corners in one place
}

/// The smallest at the corners of a quadrilateral, of the triangles that each makes with the sides that leave it. NaN
/// where the first is not valid.
constexpr double relative_shape(const QuadrilateralPoints& from, const QuadrilateralPoints& to) {
  if (!(shape_quotient(from) > 0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [i](const QuadrilateralPoints& of) {
      return CornerPoints{of[i], of[(i + 1) % 4], of[(i + 3) % 4]};
    };
    least = std::min(least, relative_shape(corner(from), corner(to)));
  }
  return least;
}

/// What a FollowResult says of shapes, of some elements. The sum apart, which depends on the order of adding.
struct RelativeShapes {
  double least;
  std::int64_t count;         ///< of those that are valid at rest
  std::int64_t invalid_held;  ///< see FollowResult

  static constexpr TRISMOOTH_HOST_DEVICE RelativeShapes none() {
    return {std::numeric_limits<double>::infinity(), 0, 0};
  }

  TRISMOOTH_HOST_DEVICE RelativeShapes& operator+=(const RelativeShapes& other) {
    least = other.least < least ? other.least : least;
    count += other.count;
    invalid_held += other.invalid_held;
    return *this;
  }
};

/// Of one element, in canonical order. `held`: why each vertex is; `rest`, `now`: all vertices, each in its local
/// frame; `shape` gets its shape, 0 where it has none.
template <class Corners, class Held, class Rest, class Now>
TRISMOOTH_HOST_DEVICE RelativeShapes relative_shapes(const Corners& corners, const Held& held, const Rest& rest,
                                                     const Now& now, double& shape) {
  const double found = with_kind(
      corners, [&](const auto& element) { return relative_shape(points_of(element, rest), points_of(element, now)); });
  const bool is_finite = found - found == 0;
  shape = is_finite ? found : 0;
  RelativeShapes one = RelativeShapes::none();
  if (is_finite) {
    one.least = found;
    one.count = 1;
  }
  one.invalid_held = all_are_fixed(corners, held) && !(quotient_at(corners, now) > 0) ? 1 : 0;
  return one;
}

/// Fills in what a FollowResult says of these. `sum`: of all shapes.
inline void tell(const RelativeShapes& shapes, double sum, FollowResult& result) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  result.min_relative_shape = shapes.count > 0 ? shapes.least : none;
  result.mean_relative_shape = shapes.count > 0 ? sum / static_cast<double>(shapes.count) : none;
  result.invalid_held = shapes.invalid_held;
}

}  // namespace trismooth

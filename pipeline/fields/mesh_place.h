// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "trismooth/base/point2.h"

namespace trismooth {

/// A place in a triangle mesh: the triangle that holds it, and how much each of its corners counts there. The weights
/// are not negative, and their sum is 1 to rounding.
struct MeshPlace {
  std::int32_t triangle = -1;  ///< -1: nowhere
  std::array<double, 3> weights{};
};

/// A place in a triangle, and the square of its distance from where it was looked for.
struct NearestPlace {
  std::array<double, 3> weights{};
  double squared_distance = 0;
};

/// What the corners of a triangle would count at a point: the doubled areas of the triangles that it makes with the
/// sides across from them, with the sign of the triangle's own orientation. All are 0 or more exactly where the point
/// is inside or on the edge; `total` is 0 for a triangle without area.
struct CornerAreas {
  std::array<double, 3> areas{};
  double total = 0;

  bool hold_point() const { return total > 0 && areas[0] >= 0 && areas[1] >= 0 && areas[2] >= 0; }
  /// Of a point that they hold.
  std::array<double, 3> weights() const;
};

CornerAreas corner_areas(const std::array<Point2<double>, 3>& corners, Point2<double> at);

/// The place of the triangle, which may be without area, that is nearest to the point.
NearestPlace nearest_place(const std::array<Point2<double>, 3>& corners, Point2<double> at);

}  // namespace trismooth

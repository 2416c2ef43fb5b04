// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/mesh_place.h"

#include <algorithm>
#include <cstddef>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/pipeline/fields/accurate_area.h"

namespace trismooth {

std::array<double, 3> CornerAreas::weights() const {
  const double sum = areas[0] + areas[1] + areas[2];
  return {areas[0] / sum, areas[1] / sum, areas[2] / sum};
}

CornerAreas corner_areas(const std::array<Point2<double>, 3>& corners, Point2<double> at) {
  const auto& [a, b, c] = corners;
  CornerAreas result{{doubled_area(at, b, c), doubled_area(a, at, c), doubled_area(a, b, at)}, doubled_area(a, b, c)};
  if (result.total < 0) {
    result.total = -result.total;
    for (double& area : result.areas) {
      area = -area;
    }
  }
  return result;
}

NearestPlace nearest_place(const std::array<Point2<double>, 3>& corners, Point2<double> at) {
  if (const CornerAreas areas = corner_areas(corners, at); areas.hold_point()) {
    return {areas.weights(), 0};
  }
  NearestPlace best;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Point2<double> side = corners[j] - corners[i];
    const Point2<double> to_point = at - corners[i];
    const double length = squared_length(side);
    const double along = side.x * to_point.x + side.y * to_point.y;
    const double part = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
    const Point2<double> foot{corners[i].x + part * side.x, corners[i].y + part * side.y};
    const double distance = squared_length(at - foot);
    if (i == 0 || distance < best.squared_distance) {
      best.squared_distance = distance;
      best.weights = {};
      best.weights[i] = 1 - part;
      best.weights[j] = part;
    }
  }
  return best;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/heights.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/text/digits.h"

namespace trismooth {

namespace {

constexpr double flatness = 1e-6;  // of the largest extent

bool all_equal(const ConstPointView& points) {
  for (std::size_t v = 1; v < points.size(); ++v) {
    if (!(points.z(v) == points.z(0))) {
      return false;
    }
  }
  return true;
}

}  // namespace

void HeightExtents::add(const Point2<double>& point, double z) {
  const std::array<double, 3> numbers{point.x, point.y, z};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], numbers[k]);
    high[k] = std::max(high[k], numbers[k]);
  }
}

void require_one_height(const HeightExtents& extents) {
  const std::array<double, 3>& low = extents.low;
  const std::array<double, 3>& high = extents.high;
  // Halves, so that no difference overflows.
  const auto half = [&](std::size_t k) { return low[k] <= high[k] ? high[k] / 2 - low[k] / 2 : 0; };
  if (!(half(2) <= flatness * std::max(half(0), half(1)))) {
    throw MeshError(
        "points: z runs from " + shortest_text(low[2]) + " to " + shortest_text(high[2]) +
        ", and must be the same everywhere to within 1e-6 of the mesh's extent; a mesh in a tilted plane is "
        "smoothed as a file, or by its coordinates in that plane");
  }
}

void require_one_height(const ConstPointView& points, std::span<const Point2<double>> pairs,
                        const std::function<std::vector<std::uint8_t>()>& fixed) {
  if (all_equal(points)) {
    return;
  }
  const std::vector<std::uint8_t> reasons = fixed();
  HeightExtents extents;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!hold::is_unused(reasons[v])) {
      extents.add(pairs[v], points.z(v));
    }
  }
  require_one_height(extents);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "trismooth/quality/metrics.h"
#include "trismooth/quality/region_quality.h"

namespace trismooth {

/// What some elements of a region contribute to its quality. Shapes are added up in chunks of triangles_a_chunk of the
/// region's elements, in their order, and chunks to those before them: so no rounding depends on who adds them. Bytes
/// may be copied.
struct RegionPart {
  static constexpr std::int64_t triangles_a_chunk = 1024;

  /// Adds the next element of the region.
  void add(double shape, double angle, ElementKind kind = ElementKind::triangle) {
    ++(kind == ElementKind::triangle ? sums.triangles : sums.quadrilaterals);
    sums.inverted += shape < 0 ? 1 : 0;
    sums.min_shape = std::min(sums.min_shape, shape);
    sums.min_angle = std::min(sums.min_angle, angle);
    chunk += shape;
    if (sums.elements() % triangles_a_chunk == 0) {
      sums.mean_shape += std::exchange(chunk, 0.0);
    }
  }

  /// Adds the elements behind these, which are whole chunks.
  void append(const RegionPart& next) {
    sums.triangles += next.sums.triangles;
    sums.quadrilaterals += next.sums.quadrilaterals;
    sums.inverted += next.sums.inverted;
    sums.min_shape = std::min(sums.min_shape, next.sums.min_shape);
    sums.mean_shape += next.sums.mean_shape;
    sums.min_angle = std::min(sums.min_angle, next.sums.min_angle);
    chunk = next.chunk;
  }

  /// The quality of a region of these elements.
  RegionQuality quality() const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (sums.elements() == 0) {
      return {0, 0, nan, nan, nan};
    }
    RegionQuality quality = sums;
    quality.mean_shape = (sums.mean_shape + chunk) / static_cast<double>(sums.elements());
    return quality;
  }

  /// `mean_shape` is the sum over whole chunks.
  RegionQuality sums{0, 0, std::numeric_limits<double>::infinity(), 0, std::numeric_limits<double>::infinity()};
  double chunk = 0;  ///< the sum of the shapes behind these
};

}  // namespace trismooth

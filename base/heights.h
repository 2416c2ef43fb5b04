// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/point_view.h"

namespace trismooth {

/// From where to where some points lie along x, y and z: of none from infinity to minus infinity.
struct HeightExtents {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  std::array<double, 3> low{infinity, infinity, infinity};
  std::array<double, 3> high{-infinity, -infinity, -infinity};

  void add(const Point2<double>& point, double z);
};

/// Throws MeshError unless all vertices that cells use, from whose points `extents` are, have one height z, to within
/// 1e-6 of their extent along x and y.
void require_one_height(const HeightExtents& extents);

/// Throws MeshError unless those of `points` that cells use have one height z, to within 1e-6 of their extent along x
/// and y. Points have three components and are finite; `pairs` are x and y of them. `fixed` answers why each vertex is
/// fixed (bits of namespace hold), which tells the vertices that nobody uses; it is asked only where heights differ at
/// all. Complexity: linear.
void require_one_height(const ConstPointView& points, std::span<const Point2<double>> pairs,
                        const std::function<std::vector<std::uint8_t>()>& fixed);

}  // namespace trismooth

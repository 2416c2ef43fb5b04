// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

#include "trismooth/base/point2.h"

namespace trismooth {

/// The smallest and the largest coordinates of some points; of none at first, so that `low` is above `high`.
struct Box {
  Point2<double> low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point2<double> high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(const Box& other) {
    low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
    high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
  }
  void add(Point2<double> point) { add(Box{point, point}); }
};

}  // namespace trismooth

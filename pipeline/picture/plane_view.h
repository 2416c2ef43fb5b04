// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "trismooth/base/box.h"

namespace trismooth {

/// Where the plane of a mesh is on a sheet: a part of it, as large as the place allows, in the middle of it. On sheets
/// y goes down.
class PlaneView {
 public:
  /// `window` of the plane, in the file's unit, on a place of so many pixels that begins at `corner`.
  PlaneView(const Box& window, double width, double height, Point2<double> corner = {0, 0})
      : centre_{window.low.x / 2 + window.high.x / 2, window.low.y / 2 + window.high.y / 2},
        middle_{corner.x + width / 2, corner.y + height / 2} {
    const double x = window.high.x / 2 - window.low.x / 2;
    const double y = window.high.y / 2 - window.low.y / 2;
    scale_ = x * height > y * width ? width / 2 / x : y > 0 ? height / 2 / y : 1;
  }

  /// Pixels for a unit of the file.
  double scale() const { return scale_; }
  Point2<double> pixel(Point2<double> place) const {
    return {middle_.x + (place.x - centre_.x) * scale_, middle_.y - (place.y - centre_.y) * scale_};
  }

 private:
  Point2<double> centre_;
  Point2<double> middle_;
  double scale_;
};

/// Whether the boxes have a place in common.
inline bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "trismooth/base/box.h"
#include "trismooth/base/local_frame.h"

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
    const double longer = std::max(x, y);
    if (longer > 0) {
      exponent_ = local_frame_details::exponent_of(longer);
      const double x_in_units = in_units(x);
      const double y_in_units = in_units(y);
      scale_ = x_in_units * height > y_in_units * width ? width / 2 / x_in_units : height / 2 / y_in_units;
    }
  }

  Point2<double> pixel(Point2<double> place) const {
    return {middle_.x + in_units(place.x - centre_.x) * scale_, middle_.y - in_units(place.y - centre_.y) * scale_};
  }

 private:
  /// In units of the window's size: a scale for the file's own may be beyond any number.
  double in_units(double length) const { return local_frame_details::scaled(length, -exponent_); }

  Point2<double> centre_;
  Point2<double> middle_;
  int exponent_ = 0;
  double scale_ = 1;
};

/// Whether the boxes have a place in common.
inline bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

}  // namespace trismooth

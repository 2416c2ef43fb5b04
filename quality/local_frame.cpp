#include "trismooth/quality/local_frame.h"

#include <algorithm>
#include <limits>

namespace trismooth {

namespace {

constexpr int no_extent = std::numeric_limits<int>::min();

struct Axis {
  double centre = 0;
  int exponent = no_extent;  ///< the extent is within [2^(exponent - 1), 2^exponent]
};

Axis fit_axis(double low, double high) {
  if (low == high) {
    return {low, no_extent};
  }
  // In units of the largest coordinate neither sum nor difference overflows, and subnormals have room below them.
  const int unit = std::ilogb(std::max(std::abs(low), std::abs(high)));
  const double low_in_units = std::ldexp(low, -unit);
  const double high_in_units = std::ldexp(high, -unit);
  const double extent = high_in_units - low_in_units;
  const double middle = (low_in_units + high_in_units) / 2;

  Axis axis;
  axis.exponent = std::ilogb(extent) + unit + 1;
  // Beyond this distance every coordinate is between half and twice the centre, so the subtraction is exact.
  if (std::abs(middle) >= 1.5 * extent) {
    // A centre of few digits is representable where the coordinates are, in the subnormal range too: the frame of a
    // mesh scaled by a power of two is then scaled exactly.
    const int grid = std::ilogb(extent) - 3;
    axis.centre = std::ldexp(std::round(std::ldexp(middle, -grid)), grid + unit);
  }
  return axis;
}

}  // namespace

LocalFrame local_frame(std::span<const Point2<double>> stored) {
  if (stored.empty()) {
    return {};
  }
  Point2<double> low = stored.front();
  Point2<double> high = stored.front();
  for (const Point2<double> point : stored) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  return local_frame(low, high);
}

LocalFrame local_frame(Point2<double> low, Point2<double> high) {
  const Axis x = fit_axis(low.x, high.x);
  const Axis y = fit_axis(low.y, high.y);
  const int exponent = std::max(x.exponent, y.exponent);
  return {x.centre, y.centre, exponent == no_extent ? 0 : exponent};
}

}  // namespace trismooth

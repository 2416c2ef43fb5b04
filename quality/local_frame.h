#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "trismooth/quality/point2.h"

namespace trismooth {

/// The coordinates in which a mesh is smoothed and evaluated: a translation per axis, made only where it is exact,
/// and a scale that is a power of two. Coordinates of the local frame lie within [-2, 2], the larger extent of the
/// mesh is within [1/2, 1]. So no square overflows, and no tolerance depends on the unit of the file.
///
/// Entering rounds nothing, and leaving gives the stored coordinate back, except for a coordinate that is not 0 and
/// smaller than 2^-1021 times the larger extent: it enters the subnormal range and may lose digits there.
struct LocalFrame {
  double centre_x = 0;  ///< subtracted; 0 where |centre| is below 1.5 times the extent along x
  double centre_y = 0;
  int exponent = 0;  ///< local = (stored - centre) * 2^-exponent

  /// From the coordinates of the file to the local frame.
  TRISMOOTH_HOST_DEVICE Point2<double> enter(Point2<double> stored) const {
    return {scaled(stored.x - centre_x, -exponent), scaled(stored.y - centre_y, -exponent)};
  }

  /// From the local frame to the coordinates of the file; one rounding, none where the axis is not translated.
  TRISMOOTH_HOST_DEVICE Point2<double> leave(Point2<double> local) const {
    return {translated(scaled(local.x, exponent), centre_x), translated(scaled(local.y, exponent), centre_y)};
  }

  /// 2^exponent: lengths in units of the file are local lengths times this. Infinite or 0 beyond the range of
  /// double, as it may be for the largest and the smallest meshes.
  double length_scale() const { return std::ldexp(1.0, exponent); }

 private:
  /// value * 2^power for |power| <= 2044, in two steps since 2^power alone may be out of range.
  static TRISMOOTH_HOST_DEVICE double scaled(double value, int power) {
    const int half = power / 2;
    return value * power_of_two(half) * power_of_two(power - half);
  }
  /// 2^power for |power| <= 1022, from its bits: cheap enough to recompute for every point.
  static TRISMOOTH_HOST_DEVICE double power_of_two(int power) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(power) + 1023) << 52U);
  }
  /// value + centre that keeps the sign of a zero where there is no translation.
  static TRISMOOTH_HOST_DEVICE double translated(double value, double centre) {
    return centre == 0 ? value : value + centre;
  }
};

/// The local frame of the points, which are finite. A mesh scaled by a power of two enters its own frame with the same
/// bits. An axis along which all points are equal is translated to 0. No points: the identity. Complexity: linear.
LocalFrame local_frame(std::span<const Point2<double>> stored);

/// The same from the corners of the points' bounding box.
LocalFrame local_frame(Point2<double> low, Point2<double> high);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "trismooth/base/box.h"
#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// What the local frame is made of: powers of two from their bits, which give the same on the host and on the device
/// and are cheap enough to recompute for every point.
namespace local_frame_details {

/// 2^power for |power| <= 1022.
inline TRISMOOTH_HOST_DEVICE double power_of_two(int power) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(power) + 1023) << 52U);
}

/// value * 2^power for |power| <= 2044, in two steps since 2^power alone may be out of range.
inline TRISMOOTH_HOST_DEVICE double scaled(double value, int power) {
  const int half = power / 2;
  return value * power_of_two(half) * power_of_two(power - half);
}

/// The largest e with 2^e <= |value|, for a normal number.
inline TRISMOOTH_HOST_DEVICE int normal_exponent(double value) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52U & 0x7FFU) - 1023;
}

/// The largest e with 2^e <= |value|, for any finite number but 0: a subnormal one is made normal first.
inline TRISMOOTH_HOST_DEVICE int exponent_of(double value) {
  return std::abs(value) < std::numeric_limits<double>::min() ? normal_exponent(value * 0x1p54) - 54
                                                              : normal_exponent(value);
}

struct Axis {
  static constexpr int no_extent = std::numeric_limits<int>::min();

  double centre = 0;
  int exponent = no_extent;  ///< the extent is within [2^(exponent - 1), 2^exponent]
};

inline TRISMOOTH_HOST_DEVICE Axis fit_axis(double low, double high) {
  Axis axis;
  if (low == high) {
    // Added to, a zero has lost its sign: which of two zeros is the lowest depends on who looks first.
    axis.centre = low + 0.0;
    return axis;
  }
  // In units of the largest coordinate neither sum nor difference overflows, and subnormals have room below them.
  const double largest = std::abs(low) > std::abs(high) ? low : high;
  const int unit = exponent_of(largest);
  const double low_in_units = scaled(low, -unit);
  const double high_in_units = scaled(high, -unit);
  const double extent = high_in_units - low_in_units;
  const double middle = (low_in_units + high_in_units) / 2;

  const int extent_exponent = exponent_of(extent);
  axis.exponent = extent_exponent + unit + 1;
  // Beyond this distance every coordinate is between half and twice the centre, so the subtraction is exact.
  if (std::abs(middle) >= 1.5 * extent) {
    // A centre of few digits is representable where the coordinates are, in the subnormal range too: the frame of a
    // mesh scaled by a power of two is then scaled exactly.
    const int grid = extent_exponent - 3;
    axis.centre = scaled(std::round(scaled(middle, -grid)), grid + unit);
  }
  return axis;
}

}  // namespace local_frame_details

/// The coordinates in which a mesh is smoothed and evaluated: a translation per axis, made only where it is exact,
/// and a scale that is a power of two. Coordinates of the local frame lie within [-2, 2], the larger extent of the
/// mesh is within [1/2, 1]. So no square overflows, and no tolerance depends on the unit of the file. A vertex that had
/// no say in the frame may be anywhere: it enters within [-4, 4], so that nobody meets an infinite coordinate.
///
/// Entering rounds nothing, and leaving gives the stored coordinate back, except for a coordinate that is not 0 and
/// smaller than 2^-1021 times the larger extent: it enters the subnormal range and may lose digits there.
struct LocalFrame {
  double centre_x = 0;  ///< subtracted; 0 where |centre| is below 1.5 times the extent along x
  double centre_y = 0;
  int exponent = 0;  ///< local = (stored - centre) * 2^-exponent

  /// From the coordinates of the file to the local frame.
  [[nodiscard]] TRISMOOTH_HOST_DEVICE Point2<double> enter(Point2<double> stored) const {
    using local_frame_details::scaled;
    constexpr double farthest = 4;
    return {within(farthest, scaled(stored.x - centre_x, -exponent)),
            within(farthest, scaled(stored.y - centre_y, -exponent))};
  }

  /// From the local frame to the coordinates of the file; one rounding, none where the axis is not translated. What is
  /// beyond `largest`, the largest number that the file can hold, becomes it: rounding may bring the mean of such
  /// numbers there.
  [[nodiscard]] TRISMOOTH_HOST_DEVICE Point2<double> leave(Point2<double> local,
                                                           double largest = std::numeric_limits<double>::max()) const {
    using local_frame_details::scaled;
    return {within(largest, translated(scaled(local.x, exponent), centre_x)),
            within(largest, translated(scaled(local.y, exponent), centre_y))};
  }

  /// 2^exponent: lengths in units of the file are local lengths times this. Infinite or 0 beyond the range of
  /// double, as it may be for the largest and the smallest meshes.
  [[nodiscard]] double length_scale() const { return std::ldexp(1.0, exponent); }

 private:
  /// value + centre that keeps the sign of a zero where there is no translation.
  static TRISMOOTH_HOST_DEVICE double translated(double value, double centre) {
    return centre == 0 ? value : value + centre;
  }
  static TRISMOOTH_HOST_DEVICE double within(double largest, double value) {
    return value > largest ? largest : (value < -largest ? -largest : value);
  }
};

/// The local frame of the points, which are finite. A mesh scaled by a power of two enters its own frame with the same
/// bits. An axis along which all points are equal is translated to 0. No points: the identity. Complexity: linear.
[[nodiscard]] LocalFrame local_frame(std::span<const Point2<double>> stored);

/// The local frame from the corners of the points' bounding box, on the host or on the device. Corners in the wrong
/// order are those of no points.
[[nodiscard]] inline TRISMOOTH_HOST_DEVICE LocalFrame local_frame(Point2<double> low, Point2<double> high) {
  if (!(low.x <= high.x && low.y <= high.y)) {
    return {};
  }
  using local_frame_details::Axis;
  const Axis x = local_frame_details::fit_axis(low.x, high.x);
  const Axis y = local_frame_details::fit_axis(low.y, high.y);
  const int exponent = x.exponent > y.exponent ? x.exponent : y.exponent;
  return {x.centre, y.centre, exponent == Axis::no_extent ? 0 : exponent};
}

/// The local frame of the points for whose numbers `counts(std::size_t)` is true: a mesh's frame is that of the
/// vertices that its cells use.
template <class Counts>
[[nodiscard]] LocalFrame local_frame(std::span<const Point2<double>> stored, const Counts& counts) {
  Box box;
  for (std::size_t v = 0; v < stored.size(); ++v) {
    if (counts(v)) {
      box.add(stored[v]);
    }
  }
  return local_frame(box.low, box.high);
}

}  // namespace trismooth

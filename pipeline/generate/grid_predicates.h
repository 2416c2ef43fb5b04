// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace trismooth {

/// A point of an integer grid; both coordinates lie in [0, 2^30).
using GridPoint = std::array<std::int32_t, 2>;

/// Bits of a GridPoint's coordinate.
inline constexpr int grid_bits = 30;

/// Twice the signed area of (a, b, c), positive where it is counter-clockwise, 0 where the points are collinear.
/// Exact: differences stay below 2^30 in magnitude, the result below 2^61.
constexpr std::int64_t doubled_area(GridPoint a, GridPoint b, GridPoint c) {
  const std::int64_t ab_x = b[0] - a[0];
  const std::int64_t ab_y = b[1] - a[1];
  const std::int64_t ac_x = c[0] - a[0];
  const std::int64_t ac_y = c[1] - a[1];
  return ab_x * ac_y - ab_y * ac_x;
}

/// True where p lies strictly inside the circle through a, b and c, which are counter-clockwise. Exact: squared
/// lengths and doubled areas stay below 2^61, so the determinant stays below 2^124. With the widening multiplication
/// of 64-bit processors that costs no more than floating-point arithmetic and a test of its error bound would.
constexpr bool in_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint p) {
  __extension__ using Int128 = __int128;
  const std::int64_t ax = a[0] - p[0];
  const std::int64_t ay = a[1] - p[1];
  const std::int64_t bx = b[0] - p[0];
  const std::int64_t by = b[1] - p[1];
  const std::int64_t cx = c[0] - p[0];
  const std::int64_t cy = c[1] - p[1];
  return Int128{ax * ax + ay * ay} * (bx * cy - by * cx) + Int128{bx * bx + by * by} * (cx * ay - cy * ax) +
             Int128{cx * cx + cy * cy} * (ax * by - ay * bx) >
         0;
}

}  // namespace trismooth

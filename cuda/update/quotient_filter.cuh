// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime.h>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/ring_elements.h"

/// Decides most smart moves without dividing.
///
/// A smart move compares the smallest rounded quotients cross / sum before and after. Here a quotient is approximated,
/// doubled, by cross * y with y close to 1 / h, where h = |a|^2 + |b|^2 - a.b of the spokes a and b is half the sum.
/// The spokes are the very same rounded differences as in shape_quotient(); with u the unit roundoff:
///   cross: off by at most 2 u |a||b|, both in the rounded quotient and here; |a||b| <= h.
///   sum: 7 u relative in the rounded quotient, its edge taken from the points and not from the spokes included
///     (|b - a|^2 off by at most 4 u (|a|^2 + |b|^2)); h: 6 u (|a|^2 + |b|^2) <= 12 u h.
///   A doubled quotient is at most 0.58; the division and the product add u each, y its own error: 2 u in float, where
///   rcp.approx.ftz.f32 is within one unit in the last place; below 2^-35 in double, where rcp.approx.ftz.f64 is within
///   2^-18 and a Newton step squares that.
/// Together a doubled quotient is off by less than 24 u, or 24 u + 2^-35. The bands below are more than twice as wide:
/// where two approximations are further apart than the band, their order is that of the rounded quotients.
///
/// At a corner of a quadrilateral, between the sides a and b, half the shape is approximated, by cross * y with y close
/// to 1 / sum, where sum = |a|^2 + |b|^2 >= 2 |a||b|, and compared with the smallest of these. It is at most 0.5.
///   In float cross and sum are those of the rounded shape: y is off by 2 u, the product and the quotient add u each,
///   so a shape's half is off by 2 u and two of them by 4 u. In double cross is off by at most u sum, and sum by 3 u
///   relative, in the shape and here: together with y less than 6 u + 2^-36, and two of them 12 u + 2^-35.
/// The band is wider by more than what is lost by the factor that makes a quotient of a shape, which keeps the order.
///
/// Nothing may underflow on the way. Where both coordinates of the point that spokes begin at are at least 2^-20 in
/// size, a spoke's coordinate is 0 or at least 2^-73, so h is 0 or far above the smallest normal number; where it is 0
/// the approximation is no number, and is treated as unsound. The sum at a corner of a quadrilateral has to be at least
/// smallest_sum: beside that what underflows of its other side is nothing.
namespace trismooth::cuda {

template <class T>
struct FilterBand;
template <>
struct FilterBand<float> {
  static constexpr float value = 0x1p-18F;
  static constexpr float of_corners = 0x1p-21F;  ///< of what approximate_corner() answers
};
template <>
struct FilterBand<double> {
  static constexpr double value = 0x1p-33;
  static constexpr double of_corners = 0x1p-34;
};

template <class T>
__device__ bool is_sound_origin(Point2<T> point) {
  constexpr T smallest = T(0x1p-20);
  return (fabs(point.x) >= smallest) & (fabs(point.y) >= smallest);
}

__device__ inline float approximate_reciprocal(float value) {
  float result;
  asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(result) : "f"(value));
  return result;
}
__device__ inline double approximate_reciprocal(double value) {
  double result;
  asm("rcp.approx.ftz.f64 %0, %1;" : "=d"(result) : "d"(value));
  const double error = __fma_rn(-value, result, 1.0);
  return __fma_rn(result, error, result);
}

// Fused on purpose: nothing that comes out of here is stored.
__device__ inline float fused(float a, float b, float c) {
  return __fmaf_rn(a, b, c);
}
__device__ inline double fused(double a, double b, double c) {
  return __fma_rn(a, b, c);
}

/// Twice the shape quotient, approximately.
template <class T>
__device__ T approximate_quotient(const TriangleCorner<RingSpoke<T>>& corner) {
  const Point2<T> a = corner.next.edge;
  const Point2<T> b = corner.previous.edge;
  const T cross = fused(a.x, b.y, -(a.y * b.x));
  const T half_sum = fused(-a.x, b.x, fused(-a.y, b.y, corner.next.squared + corner.previous.squared));
  return cross * approximate_reciprocal(half_sum);
}

/// See above.
constexpr double smallest_sum = 0x1p-80;

// In float these are the very numbers of the rounded shape: its unit roundoff is so large that the band has to be
// narrow.
__device__ inline float approximate_squared_length(Point2<float> side) {
  return squared_length(side);
}
__device__ inline double approximate_squared_length(Point2<double> side) {
  return fused(side.x, side.x, side.y * side.y);
}
__device__ inline float approximate_cross(Point2<float> a, Point2<float> b) {
  return cross(a, b);
}
__device__ inline double approximate_cross(Point2<double> a, Point2<double> b) {
  return fused(a.x, b.y, -(a.y * b.x));
}

/// Half the shape of a quadrilateral at the corner between two sides, approximately. `sum`: of their squared lengths.
template <class T>
__device__ T approximate_corner(Point2<T> a, Point2<T> b, T sum) {
  return approximate_cross(a, b) * approximate_reciprocal(sum);
}

/// The smaller one; no number if one is none.
__device__ inline float smaller(float a, float b) {
  float result;
  asm("min.NaN.f32 %0, %1, %2;" : "=f"(result) : "f"(a), "f"(b));
  return result;
}
__device__ inline double smaller(double a, double b) {
  return a - a == 0 && !(b >= a) ? b : a;
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/point2.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

/// The quality of a quadrilateral at the corner where the side `in` ends and the side `out` begins, of these squared
/// lengths: 2 cross(in, out) / (|in|^2 + |out|^2). 1 where they are equal and turn to the left by a right angle, 0
/// where they are in line or have no length, below 0 where the corner points inwards. One division.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T corner_shape(Point2<T> in, Point2<T> out, T in2, T out2) {
  const T sum = in2 + out2;
  const T area = cross(in, out);
  return sum == T(0) ? T(0) : (area + area) / sum;
}

/// The signed shape of the quadrilateral with these sides in turn, in [-1, 1] up to rounding: the smallest
/// corner_shape(), Verdict's shape where it is convex. 1 for a square; below 0 where it is not convex, or clockwise.
/// The same bits whichever side comes first.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_of_sides(Point2<T> ab, Point2<T> bc, Point2<T> cd, Point2<T> da) {
  const T ab2 = squared_length(ab);
  const T bc2 = squared_length(bc);
  const T cd2 = squared_length(cd);
  const T da2 = squared_length(da);
  const T at_a = corner_shape(da, ab, da2, ab2);
  const T at_b = corner_shape(ab, bc, ab2, bc2);
  const T at_c = corner_shape(bc, cd, bc2, cd2);
  const T at_d = corner_shape(cd, da, cd2, da2);
  const T one = at_b < at_a ? at_b : at_a;
  const T other = at_d < at_c ? at_d : at_c;
  return other < one ? other : one;
}

/// That of the quadrilateral (a, b, c, d).
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape(Point2<T> a, Point2<T> b, Point2<T> c, Point2<T> d) {
  return shape_of_sides(b - a, c - b, d - c, a - d);
}

/// The shape as the quotient of a triangle that is as good (see triangle_quality.h): by it elements of both kinds are
/// compared.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_quotient(Point2<T> a, Point2<T> b, Point2<T> c, Point2<T> d) {
  return T(1 / shape_constant) * shape(a, b, c, d);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// The Lee-Lo quality of a triangle (C. K. Lee and S. H. Lo 1994; the paper's alpha), in its signed form:
///
///     alpha(a, b, c) = 2 sqrt(3) cross(b - a, c - a) / (|b - a|^2 + |c - b|^2 + |a - c|^2)
///
/// 1 is equilateral, 0 degenerate (also where all three corners coincide), below 0 clockwise. Every decision of the
/// smoothing compares the quotient alone; the constant is left out. These functions are the only definition of it.
///
/// The value depends in its last digits on which corner comes first, never on the order of the other operations:
/// the compiler may not fuse or reorder them (-ffp-contract=off, -fmad=false).

/// 2 sqrt(3): the factor from shape_quotient to shape.
inline constexpr double shape_constant = 3.4641016151377545870548926830117;

/// alpha / (2 sqrt(3)) from the edge vectors at corner a and the squared lengths of the three edges.
/// Complexity: one division. 0 where the sum of the squares is 0.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_quotient(Point2<T> ab, Point2<T> ac, T ab2, T bc2, T ca2) {
  const T sum = ab2 + bc2 + ca2;
  return sum == T(0) ? T(0) : cross(ab, ac) / sum;
}

/// alpha / (2 sqrt(3)) of the triangle (a, b, c), positive where it is counter-clockwise.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_quotient(Point2<T> a, Point2<T> b, Point2<T> c) {
  const Point2<T> ab = b - a;
  const Point2<T> ac = c - a;
  return shape_quotient(ab, ac, squared_length(ab), squared_length(c - b), squared_length(ac));
}

/// alpha, the signed shape of the triangle (a, b, c), in [-1, 1] up to rounding.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape(Point2<T> a, Point2<T> b, Point2<T> c) {
  return T(shape_constant) * shape_quotient(a, b, c);
}

}  // namespace trismooth

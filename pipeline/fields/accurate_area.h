// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/point2.h"

namespace trismooth {

/// Twice the signed area of the triangle (a, b, c), positive where it is counter-clockwise: of the right sign always,
/// and right to 12 digits, however thin the triangle is. The points are in a local frame, so nothing overflows; what is
/// lost below the smallest numbers of double does not count.
///
/// Where the difference of the two products says enough it is the result. Else all six products of coordinates are
/// added without rounding, as a sum of numbers that do not overlap: Shewchuk, Adaptive Precision Floating-Point
/// Arithmetic and Fast Robust Geometric Predicates, 1997.
double doubled_area(Point2<double> a, Point2<double> b, Point2<double> c);

}  // namespace trismooth

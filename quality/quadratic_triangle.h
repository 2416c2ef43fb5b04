// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>

#include "trismooth/base/point2.h"
#include "trismooth/quality/jacobian_bound.h"

namespace trismooth {

/// Whether a triangle of six nodes, with curved sides, is valid: whether the determinant J of the Jacobian of its
/// quadratic map from the straight triangle is positive everywhere. J is a polynomial of degree 2, so its smallest
/// value is known in closed form: it is at a corner, where J is stationary on a side, or where it is stationary inside.
/// The coefficients are those in the Bernstein basis, after A. Johnen, J.-F. Remacle and C. Geuzaine, "Geometrical
/// validity of curvilinear finite elements", Journal of Computational Physics 233 (2013), 359-372.
///
/// These functions are the only definition of it. Coordinates are of the local frame.

/// The nodes of a triangle: its corners 0, 1, 2, counter-clockwise, then the middles of 01, 12 and 20.
using QuadraticNodes = std::array<Point2<double>, 6>;

/// The coefficients of a polynomial of degree 2 on a triangle, in the Bernstein basis: its values at the corners, then
/// those that belong to the sides 01, 12 and 20.
using BernsteinCoefficients = std::array<double, 6>;

namespace quadratic_details {

/// The smallest value between two corners, along a side that has these coefficients.
constexpr TRISMOOTH_HOST_DEVICE double smallest_on_side(double first, double middle, double second) {
  const double down_first = first - middle;
  const double down_second = second - middle;
  if (down_first > 0 && down_second > 0) {
    return first - down_first * (down_first / (down_first + down_second));
  }
  return first < second ? first : second;
}

/// The value where the polynomial has its minimum if that is inside the triangle, else infinity. From corner 0 the
/// polynomial is c0 + 2 (g1 l1 + g2 l2) + h11 l1^2 + 2 h12 l1 l2 + h22 l2^2. Elimination begins at the larger of h11
/// and h22, which leaves a small residual however flat the polynomial is in one direction; and what is returned is a
/// value within the triangle, so it is never below the smallest one.
constexpr TRISMOOTH_HOST_DEVICE double smallest_inside(const BernsteinCoefficients& c) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double h11 = (c[0] - c[3]) + (c[1] - c[3]);
  const double h22 = (c[0] - c[5]) + (c[2] - c[5]);
  const double h12 = (c[0] - c[3]) + (c[4] - c[5]);
  const double g1 = c[3] - c[0];
  const double g2 = c[5] - c[0];
  const bool first_is_larger = h11 >= h22;
  const double pivot = first_is_larger ? h11 : h22;
  if (!(pivot > 0)) {
    return none;
  }
  const double factor = h12 / pivot;
  const double rest = (first_is_larger ? h22 : h11) - factor * h12;
  if (!(rest > 0)) {
    return none;
  }
  const double g_pivot = first_is_larger ? g1 : g2;
  const double g_other = first_is_larger ? g2 : g1;
  const double other = (factor * g_pivot - g_other) / rest;
  const double at_pivot = (-g_pivot - h12 * other) / pivot;
  const double l1 = first_is_larger ? at_pivot : other;
  const double l2 = first_is_larger ? other : at_pivot;
  const double l0 = 1 - l1 - l2;
  if (!(l0 > 0 && l1 > 0 && l2 > 0)) {
    return none;
  }
  return l0 * (c[0] * l0 + 2 * c[3] * l1) + l1 * (c[1] * l1 + 2 * c[4] * l2) + l2 * (c[2] * l2 + 2 * c[5] * l0);
}

constexpr TRISMOOTH_HOST_DEVICE double larger(double a, double b) {
  const double size = b < 0 ? -b : b;
  return size > a ? size : a;
}

}  // namespace quadratic_details

/// The smallest value of the polynomial on the closed triangle, but for rounding of some 32 times the largest
/// coefficient. Constant time.
constexpr TRISMOOTH_HOST_DEVICE double smallest_value(const BernsteinCoefficients& c) {
  double smallest = quadratic_details::smallest_on_side(c[0], c[3], c[1]);
  for (const double value :
       {quadratic_details::smallest_on_side(c[1], c[4], c[2]), quadratic_details::smallest_on_side(c[2], c[5], c[0]),
        quadratic_details::smallest_inside(c)}) {
    smallest = value < smallest ? value : smallest;
  }
  return smallest;
}

/// The coefficients of J.
constexpr TRISMOOTH_HOST_DEVICE BernsteinCoefficients jacobian_coefficients(const QuadraticNodes& nodes) {
  // The map's control points, from corner 0: side01 belongs to the side 01.
  const Point2<double> corner1 = nodes[1] - nodes[0];
  const Point2<double> corner2 = nodes[2] - nodes[0];
  const Point2<double> middle01 = nodes[3] - nodes[0];
  const Point2<double> middle12 = nodes[4] - nodes[0];
  const Point2<double> middle20 = nodes[5] - nodes[0];
  const Point2<double> side01{2 * middle01.x - corner1.x / 2, 2 * middle01.y - corner1.y / 2};
  const Point2<double> side12{2 * middle12.x - (corner1.x + corner2.x) / 2,
                              2 * middle12.y - (corner1.y + corner2.y) / 2};
  const Point2<double> side20{2 * middle20.x - corner2.x / 2, 2 * middle20.y - corner2.y / 2};
  // Half of the map's derivatives towards corners 1 and 2 are linear, with these values at the corners.
  const std::array<Point2<double>, 3> to1{side01, corner1 - side01, side12 - side20};
  const std::array<Point2<double>, 3> to2{side20, side12 - side01, corner2 - side20};
  return {4 * cross(to1[0], to2[0]),
          4 * cross(to1[1], to2[1]),
          4 * cross(to1[2], to2[2]),
          2 * (cross(to1[0], to2[1]) + cross(to1[1], to2[0])),
          2 * (cross(to1[1], to2[2]) + cross(to1[2], to2[1])),
          2 * (cross(to1[2], to2[0]) + cross(to1[0], to2[2]))};
}

/// The smallest J of the element. Constant time.
constexpr TRISMOOTH_HOST_DEVICE JacobianBound jacobian_bound(const QuadraticNodes& nodes) {
  // Differences of nodes are right to half a digit. Derivatives are sums of up to 6 times the largest of them, and a
  // coefficient is 8 products of two of these, so it is below 8 * 6 * 6; that times the rounding of some 10 operations
  // for itself and of some 32 for the smallest value bounds it amply.
  constexpr double operations = 16384;
  double width = 0;
  double height = 0;
  for (int node = 1; node < 6; ++node) {
    width = quadratic_details::larger(width, nodes[node].x - nodes[0].x);
    height = quadratic_details::larger(height, nodes[node].y - nodes[0].y);
  }
  JacobianBound bound;
  bound.straight = cross(nodes[1] - nodes[0], nodes[2] - nodes[0]);
  bound.rounding = operations * (std::numeric_limits<double>::epsilon() / 2) * width * height;
  bound.lowest = smallest_value(jacobian_coefficients(nodes));
  return bound;
}

}  // namespace trismooth

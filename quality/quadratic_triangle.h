#pragma once

#include <array>
#include <limits>

#include "trismooth/base/point2.h"

namespace trismooth {

/// Whether a triangle of six nodes, with curved sides, is valid: whether the determinant J of the Jacobian of its
/// quadratic map from the straight triangle is positive everywhere. J is a polynomial of degree 2, and its smallest
/// coefficient in the Bernstein basis is below all of its values; where that does not decide, the triangle is cut into
/// four, whose coefficients are closer. After A. Johnen, J.-F. Remacle and C. Geuzaine, "Geometrical validity of
/// curvilinear finite elements", Journal of Computational Physics 233 (2013), 359-372.
///
/// These functions are the only definition of it. Coordinates are of the local frame.

/// The nodes of a triangle: its corners 0, 1, 2, counter-clockwise, then the middles of 01, 12 and 20.
using QuadraticNodes = std::array<Point2<double>, 6>;

/// The coefficients of a polynomial of degree 2 on a triangle, in the Bernstein basis: its values at the corners, then
/// those that belong to the sides 01, 12 and 20.
using BernsteinCoefficients = std::array<double, 6>;

/// What is known of J, in units of the local frame.
struct JacobianBound {
  double straight = 0;  ///< J of the straight triangle of the corners, twice its area
  double lowest = 0;    ///< no value of J is smaller
  double rounding = 0;  ///< how far rounding may have brought `lowest` off

  /// J is positive everywhere, rounding allowed for. False also where nothing was decided, which is within a few per
  /// cent of J = 0 in a small part of the triangle.
  constexpr TRISMOOTH_HOST_DEVICE bool is_valid() const { return lowest > rounding; }
  /// The smallest J by that of the straight triangle: 1 where sides are straight and middles in the middle, 0 or less
  /// where the element is not valid. Minus infinity where the straight triangle has no area.
  constexpr TRISMOOTH_HOST_DEVICE double scaled() const {
    const double size = straight < 0 ? -straight : straight;
    return size > 0 ? lowest / size : -std::numeric_limits<double>::infinity();
  }
};

namespace quadratic_details {

constexpr TRISMOOTH_HOST_DEVICE double smallest_of(const BernsteinCoefficients& c) {
  double smallest = c[0];
  for (int i = 1; i < 6; ++i) {
    smallest = c[i] < smallest ? c[i] : smallest;
  }
  return smallest;
}

/// No value of the polynomial is smaller. Cuts the triangle into four, and these again, `cuts` times at most, until it
/// is known whether all values are above `enough`.
constexpr TRISMOOTH_HOST_DEVICE double lower_bound(const BernsteinCoefficients& c, double enough, int cuts) {
  const double smallest = smallest_of(c);
  // At corners the coefficients are values.
  const bool is_below = c[0] <= enough || c[1] <= enough || c[2] <= enough;
  if (smallest > enough || is_below || cuts == 0) {
    return smallest;
  }
  const double middle01 = (c[0] + 2 * c[3] + c[1]) / 4;
  const double middle12 = (c[1] + 2 * c[4] + c[2]) / 4;
  const double middle20 = (c[2] + 2 * c[5] + c[0]) / 4;
  const double side0 = (c[0] + c[3] + c[4] + c[5]) / 4;
  const double side1 = (c[1] + c[3] + c[4] + c[5]) / 4;
  const double side2 = (c[2] + c[3] + c[4] + c[5]) / 4;
  const std::array<BernsteinCoefficients, 4> parts{
      {{c[0], middle01, middle20, (c[0] + c[3]) / 2, side0, (c[0] + c[5]) / 2},
       {c[1], middle12, middle01, (c[1] + c[4]) / 2, side1, (c[1] + c[3]) / 2},
       {c[2], middle20, middle12, (c[2] + c[5]) / 2, side2, (c[2] + c[4]) / 2},
       {middle01, middle12, middle20, side1, side2, side0}}};
  double lowest = lower_bound(parts[0], enough, cuts - 1);
  for (int part = 1; part < 4; ++part) {
    const double bound = lower_bound(parts[part], enough, cuts - 1);
    lowest = bound < lowest ? bound : lowest;
  }
  return lowest;
}

constexpr TRISMOOTH_HOST_DEVICE double larger(double a, double b) {
  const double size = b < 0 ? -b : b;
  return size > a ? size : a;
}

}  // namespace quadratic_details

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

/// What is known of J of the element.
constexpr TRISMOOTH_HOST_DEVICE JacobianBound jacobian_bound(const QuadraticNodes& nodes) {
  constexpr int cuts = 2;
  // Differences of nodes are right to half a digit. Derivatives are sums of up to 6 times the largest of them, and a
  // coefficient is 8 products of two of these: 8 * 6 * 6 * (rounding of some 10 operations) bounds it amply.
  constexpr double operations = 4096;
  double width = 0;
  double height = 0;
  for (int node = 1; node < 6; ++node) {
    width = quadratic_details::larger(width, nodes[node].x - nodes[0].x);
    height = quadratic_details::larger(height, nodes[node].y - nodes[0].y);
  }
  JacobianBound bound;
  bound.straight = cross(nodes[1] - nodes[0], nodes[2] - nodes[0]);
  bound.rounding = operations * (std::numeric_limits<double>::epsilon() / 2) * width * height;
  bound.lowest = quadratic_details::lower_bound(jacobian_coefficients(nodes), bound.rounding, cuts);
  return bound;
}

}  // namespace trismooth

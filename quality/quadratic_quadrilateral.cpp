// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quadratic_quadrilateral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace trismooth {

namespace {

/// The coefficients of a polynomial of degree 3 in each of both directions, in the Bernstein basis of a square: a row
/// for each of the second one. Those at the four ends are values of the polynomial.
using Bicubic = std::array<std::array<double, 4>, 4>;

/// A map of degree 2 in each direction, by its control points, row by row.
using ControlPoints = std::array<std::array<Point2<double>, 3>, 3>;

/// The control point of a side between those at its ends, of which the node lies in the middle.
Point2<double> between(Point2<double> first, Point2<double> node, Point2<double> second) {
  return {2 * node.x - (first.x + second.x) / 2, 2 * node.y - (first.y + second.y) / 2};
}

/// From corner 0.
ControlPoints control_points(const BiquadraticNodes& nodes) {
  constexpr std::array<std::array<std::size_t, 3>, 3> rows{{{0, 4, 1}, {7, 8, 5}, {3, 6, 2}}};
  ControlPoints points;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 3; ++i) {
      points[row][i] = nodes[rows[row][i]] - nodes[0];
    }
    points[row][1] = between(points[row][0], points[row][1], points[row][2]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    points[1][i] = between(points[0][i], points[1][i], points[2][i]);
  }
  return points;
}

/// The coefficients of J: the product of the map's derivatives, which are of degrees 1 and 2 along, and across.
Bicubic jacobian_coefficients(const ControlPoints& points) {
  constexpr std::array<double, 2> linear{1, 1};
  constexpr std::array<double, 3> quadratic{1, 2, 1};
  constexpr std::array<double, 4> cubic{1, 3, 3, 1};
  Bicubic coefficients{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Point2<double> along = points[row][i + 1] - points[row][i];
      for (std::size_t other_row = 0; other_row < 2; ++other_row) {
        for (std::size_t j = 0; j < 3; ++j) {
          const Point2<double> across = points[other_row + 1][j] - points[other_row][j];
          const double weight = linear[i] * quadratic[j] * quadratic[row] * linear[other_row];
          coefficients[row + other_row][i + j] += weight * (4 * cross(along, across));
        }
      }
    }
  }
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t i = 0; i < 4; ++i) {
      coefficients[row][i] /= cubic[row] * cubic[i];
    }
  }
  return coefficients;
}

/// Both halves of a cubic polynomial (de Casteljau).
std::pair<std::array<double, 4>, std::array<double, 4>> halves_of(const std::array<double, 4>& c) {
  const auto mean = [](double a, double b) { return 0.5 * (a + b); };
  const double first = mean(c[0], c[1]);
  const double middle = mean(c[1], c[2]);
  const double last = mean(c[2], c[3]);
  const double near_first = mean(first, middle);
  const double near_last = mean(middle, last);
  const double half = mean(near_first, near_last);
  return {{c[0], first, near_first, half}, {half, near_last, last, c[3]}};
}

Bicubic transposed(const Bicubic& c) {
  Bicubic other;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t i = 0; i < 4; ++i) {
      other[i][row] = c[row][i];
    }
  }
  return other;
}

std::array<Bicubic, 2> halves_of(const Bicubic& c) {
  std::array<Bicubic, 2> halves;
  for (std::size_t row = 0; row < 4; ++row) {
    std::tie(halves[0][row], halves[1][row]) = halves_of(c[row]);
  }
  return halves;
}

/// The search for the smallest value: parts that may have a smaller one than those found are divided.
class SmallestValue {
 public:
  /// `tolerance`: what smaller is not worth looking for.
  SmallestValue(const Bicubic& coefficients, double tolerance) : tolerance_(tolerance) { search(coefficients, 0); }

  /// The smallest value found.
  double value() const { return found_; }
  /// How far the smallest one may be below it.
  double gap() const { return std::max(tolerance_, found_ - bound_); }

 private:
  static constexpr int most_halvings = 12;

  void search(const Bicubic& part, int halvings) {
    found_ = std::min({found_, part[0][0], part[0][3], part[3][0], part[3][3]});
    double bound = part[0][0];
    for (const auto& row : part) {
      bound = std::min(bound, *std::ranges::min_element(row));
    }
    if (bound >= found_ - tolerance_) {
      return;
    }
    if (halvings == most_halvings) {
      bound_ = std::min(bound_, bound);
      return;
    }
    for (const Bicubic& half : halves_of(part)) {
      for (const Bicubic& quarter : halves_of(transposed(half))) {
        search(quarter, halvings + 1);
      }
    }
  }

  double tolerance_;
  double found_ = std::numeric_limits<double>::infinity();
  double bound_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Point2<double> centre_of_eight(const BiquadraticNodes& nodes) {
  Point2<double> from_first{0, 0};
  for (std::size_t i = 1; i < 8; ++i) {
    const Point2<double> node = nodes[i] - nodes[0];
    const double weight = i < 4 ? -0.25 : 0.5;
    from_first = {from_first.x + weight * node.x, from_first.y + weight * node.y};
  }
  return {nodes[0].x + from_first.x, nodes[0].y + from_first.y};
}

JacobianBound jacobian_bound(const BiquadraticNodes& nodes) {
  // Differences of nodes are right to half a digit. Control points are sums of up to 9 times the largest of them, a
  // coefficient of J is a mean of products of two differences of these, so it is below 4 * 18 * 18 times width and
  // height, twice. That times the rounding of some 10 operations for itself and of 12 halvings bounds it amply.
  constexpr double operations = 524288;
  constexpr double worth_looking = 0x1p-20;
  double width = 0;
  double height = 0;
  for (const Point2<double>& node : nodes) {
    width = std::max(width, std::abs(node.x - nodes[0].x));
    height = std::max(height, std::abs(node.y - nodes[0].y));
  }
  const Bicubic coefficients = jacobian_coefficients(control_points(nodes));
  double largest = 0;
  for (const auto& row : coefficients) {
    for (const double coefficient : row) {
      largest = std::max(largest, std::abs(coefficient));
    }
  }
  const SmallestValue smallest(coefficients, worth_looking * largest);
  JacobianBound bound;
  bound.straight = 0.5 * cross(nodes[2] - nodes[0], nodes[3] - nodes[1]);
  bound.lowest = smallest.value();
  bound.rounding = operations * (std::numeric_limits<double>::epsilon() / 2) * width * height + smallest.gap();
  return bound;
}

}  // namespace trismooth

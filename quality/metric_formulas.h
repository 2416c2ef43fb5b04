// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "trismooth/quality/angle.h"
#include "trismooth/quality/kind_metrics.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/triangle_quality.h"

/// The formulas of the metrics, without branches: a loop over triangles does several at once.
namespace trismooth::metric_formulas {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double two_sqrt3 = shape_constant;
inline constexpr double two_over_sqrt3 = 2 * std::numbers::inv_sqrt3;
inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

struct Edge {
  Point2<double> vector;
  double squared_length;
};

inline Edge edge_between(Point2<double> from, Point2<double> to) {
  const Point2<double> vector = to - from;
  return {vector, squared_length(vector)};
}

/// Puts the shorter one first; equal ones stay.
inline void order(Edge& shorter, Edge& longer) {
  const bool swaps = longer.squared_length < shorter.squared_length;
  const Edge one = shorter;
  const Edge other = longer;
  shorter = {{swaps ? other.vector.x : one.vector.x, swaps ? other.vector.y : one.vector.y},
             swaps ? other.squared_length : one.squared_length};
  longer = {{swaps ? one.vector.x : other.vector.x, swaps ? one.vector.y : other.vector.y},
            swaps ? one.squared_length : other.squared_length};
}

/// A triangle by its edges in order of length, which all metrics but shape are computed from.
struct SortedEdges {
  Edge shortest, middle, longest;  ///< vectors all in one sense of rotation
  double l_min, l_mid, l_max;
  double doubled_area;  ///< not negative
  double sign;          ///< of the orientation, as in shape: -1, 0 or 1

  double perimeter() const { return l_min + l_mid + l_max; }
  bool degenerate() const { return doubled_area == 0; }
};

inline SortedEdges sort_edges(Point2<double> a, Point2<double> b, Point2<double> c, double signed_shape) {
  Edge shortest = edge_between(a, b);
  Edge middle = edge_between(b, c);
  Edge longest = edge_between(c, a);
  order(shortest, middle);
  order(middle, longest);
  order(shortest, middle);
  // Of the three corners, the one between the shorter edges loses the fewest digits in needles.
  const double area = std::abs(cross(shortest.vector, middle.vector));
  // The sign is that of shape, so that the metrics never contradict each other.
  const double of_edges = shortest.squared_length != 0 ? area : 0.0;
  const double doubled_area = signed_shape != 0 ? of_edges : 0.0;
  return {shortest,
          middle,
          longest,
          std::sqrt(shortest.squared_length),
          std::sqrt(middle.squared_length),
          std::sqrt(longest.squared_length),
          doubled_area,
          doubled_area == 0 ? 0.0 : std::copysign(1.0, signed_shape)};
}

/// Interior angle between two edges. The arc tangent keeps its digits near 0 and 180 degrees, unlike the arc cosine.
inline double angle_between(const Edge& one, const Edge& other, double doubled_area) {
  const double dot = -(one.vector.x * other.vector.x + one.vector.y * other.vector.y);
  return angle_above_axis(doubled_area, dot) * degrees_per_radian;
}

inline double area(const SortedEdges& edges) {
  return edges.sign * edges.doubled_area / 2;
}

inline double min_angle(const SortedEdges& edges) {
  const double angle = angle_between(edges.middle, edges.longest, edges.doubled_area);
  return edges.degenerate() ? 0 : angle;
}

inline double max_angle(const SortedEdges& edges) {
  const double angle = angle_between(edges.shortest, edges.middle, edges.doubled_area);
  return edges.degenerate() ? 180 : angle;
}

inline double aspect_ratio(const SortedEdges& edges) {
  const double ratio = edges.l_max * edges.perimeter() / (two_sqrt3 * edges.doubled_area);
  return edges.degenerate() ? infinity : ratio;
}

inline double radius_ratio(const SortedEdges& edges) {
  // Two quotients, since the fourth powers of short lengths would underflow.
  const double ratio =
      edges.l_min * edges.l_mid / edges.doubled_area * (edges.l_max * edges.perimeter() / edges.doubled_area) / 4;
  return edges.degenerate() ? infinity : ratio;
}

inline double edge_ratio(const SortedEdges& edges) {
  const double ratio = edges.l_max / edges.l_min;
  return edges.l_min == 0 ? infinity : ratio;
}

inline double condition(double signed_shape) {
  const double inverse = 1 / signed_shape;
  return signed_shape == 0 ? infinity : inverse;
}

inline double scaled_jacobian(const SortedEdges& edges) {
  const double jacobian = edges.sign * two_over_sqrt3 * (edges.doubled_area / (edges.l_mid * edges.l_max));
  return edges.degenerate() ? 0 : jacobian;
}

inline double equiangle_skew(double smallest_angle, double largest_angle) {
  const double by_largest = (largest_angle - 60) / 120;
  const double by_smallest = (60 - smallest_angle) / 60;
  const double larger = by_largest < by_smallest ? by_smallest : by_largest;
  return larger > 0 ? larger : 0.0;
}

/// The values of all metrics of triangles, in the order of all_metrics().
inline KindValues<CornerPoints> evaluate_all(const CornerPoints& corners) {
  const auto& [a, b, c] = corners;
  const double signed_shape = shape(a, b, c);
  const SortedEdges edges = sort_edges(a, b, c, signed_shape);
  const double smallest_angle = min_angle(edges);
  const double largest_angle = max_angle(edges);
  return {signed_shape,           area(edges),
          smallest_angle,         largest_angle,
          aspect_ratio(edges),    radius_ratio(edges),
          edge_ratio(edges),      condition(signed_shape),
          scaled_jacobian(edges), equiangle_skew(smallest_angle, largest_angle)};
}

}  // namespace trismooth::metric_formulas

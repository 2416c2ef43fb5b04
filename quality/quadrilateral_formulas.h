// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "trismooth/quality/angle.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/metric_formulas.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quadrilateral_quality.h"

/// The formulas of the metrics of quadrilaterals, without branches: a loop over them does several at once.
namespace trismooth::quadrilateral_formulas {

using metric_formulas::infinity;

inline double smallest(double a, double b) {
  return b < a ? b : a;
}
inline double largest(double a, double b) {
  return b > a ? b : a;
}

/// One corner, between the side that ends there and the side that begins there.
struct Corner {
  double angle;     ///< the interior one in degrees
  double jacobian;  ///< the sine of it, negative where the corner is clockwise
};

/// `sense`: -1 for a quadrilateral that is clockwise, whose angles are those of its mirror image.
inline Corner corner_between(Point2<double> in, Point2<double> out, double lengths, double sense) {
  const double area = cross(in, out);
  const double turned = sense * area;
  const double dot = -(in.x * out.x + in.y * out.y);
  const double acute = angle_above_axis(std::abs(area), dot) * metric_formulas::degrees_per_radian;
  const double angle = turned < 0 ? 360 - acute : acute;
  const bool has_sides = lengths > 0;
  return {angle, has_sides ? area / lengths : 0.0};
}

/// The values of all metrics of quadrilaterals, in the order of all_metrics().
inline KindValues<QuadrilateralPoints> evaluate_all(const QuadrilateralPoints& corners) {
  const auto& [a, b, c, d] = corners;
  const Point2<double> ab = b - a;
  const Point2<double> bc = c - b;
  const Point2<double> cd = d - c;
  const Point2<double> da = a - d;
  const double l0 = std::sqrt(squared_length(ab));
  const double l1 = std::sqrt(squared_length(bc));
  const double l2 = std::sqrt(squared_length(cd));
  const double l3 = std::sqrt(squared_length(da));
  const double l_min = smallest(smallest(l0, l1), smallest(l2, l3));
  const double l_max = largest(largest(l0, l1), largest(l2, l3));
  const double area = doubled_area(corners) / 2;
  const double sense = area < 0 ? -1 : 1;
  const Corner at_a = corner_between(da, ab, l3 * l0, sense);
  const Corner at_b = corner_between(ab, bc, l0 * l1, sense);
  const Corner at_c = corner_between(bc, cd, l1 * l2, sense);
  const Corner at_d = corner_between(cd, da, l2 * l3, sense);
  const bool has_sides = l_min > 0;
  const bool has_angles = has_sides & (area != 0);
  const double least = smallest(smallest(at_a.angle, at_b.angle), smallest(at_c.angle, at_d.angle));
  const double most = largest(largest(at_a.angle, at_b.angle), largest(at_c.angle, at_d.angle));
  const double min_angle = has_angles ? least : 0;
  const double max_angle = (has_angles | (most > 180)) ? most : 180;
  const double quality = shape(a, b, c, d);
  const double jacobian = smallest(smallest(at_a.jacobian, at_b.jacobian), smallest(at_c.jacobian, at_d.jacobian));
  const double deviation = largest((max_angle - 90) / 90, (90 - min_angle) / 90);
  // Twice the lines through the middles of opposite sides, and twice that between the middles of the diagonals.
  const Point2<double> along = ab - cd;
  const Point2<double> across = bc - da;
  const Point2<double> between{(a.x - b.x) + (c.x - d.x), (a.y - b.y) + (c.y - d.y)};
  const double l_along = std::sqrt(squared_length(along));
  const double l_across = std::sqrt(squared_length(across));
  const double shorter = smallest(l_along, l_across);
  const double cosine = std::abs(along.x * across.x + along.y * across.y) / (l_along * l_across);
  const double taper = std::sqrt(squared_length(between)) / shorter;
  const double ratio = l_max * ((l0 + l1) + (l2 + l3)) / (4 * std::abs(area));
  const double edge_ratio = l_max / l_min;
  const double condition = 1 / quality;
  return {quality,
          area,
          min_angle,
          max_angle,
          area == 0 ? infinity : ratio,
          has_sides ? edge_ratio : infinity,
          quality == 0 ? infinity : condition,
          jacobian,
          smallest(largest(deviation, 0.0), 1.0),
          l_along * l_across > 0 ? smallest(cosine, 1.0) : 1,
          shorter > 0 ? taper : infinity};
}

}  // namespace trismooth::quadrilateral_formulas

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "trismooth/base/point2.h"

namespace trismooth {

/// What an element is.
enum class ElementKind : std::uint8_t { triangle, quadrilateral };

/// The quality metrics of an element, by their Verdict names and definitions (C. D. Stimpson, C. D. Ernst, P. Knupp,
/// P. P. Pebay and D. Thompson, The Verdict Geometric Quality Library, SAND2007-1751). In the formulas of triangles
/// l_min, l_mid and l_max are the lengths of the edges and A is the area. Where Verdict's value would not tell a valid
/// element from an inverted one (a triangle that is clockwise, a quadrilateral that is or has a corner that points
/// inwards: shape < 0), it is given a sign here: shape, scaled_jacobian and condition are negative for inverted
/// elements, area for clockwise ones. The others are the same for both.
///
/// Of quadrilaterals: a and b are the sides that leave a corner, cross(a, b) is positive where it turns to the left,
/// the smallest and the largest are those over the four corners. radius_ratio is of triangles alone, skew and taper are
/// of quadrilaterals alone. (Verdict's warpage is 0 in a plane.)
///
///     shape            the smallest 2 cross(a, b) / (|a|^2 + |b|^2): 1 for a square
///     area             A = cross(d1, d2) / 2, of the diagonals
///     min_angle        smallest interior angle in degrees: 90 for a rectangle
///     max_angle        largest interior angle in degrees, above 180 where a corner points inwards
///     aspect_ratio     l_max (l_0 + l_1 + l_2 + l_3) / (4 |A|)
///     edge_ratio       l_max / l_min
///     condition        1 / shape
///     scaled_jacobian  the smallest cross(a, b) / (|a| |b|)
///     equiangle_skew   max((max_angle - 90) / 90, (90 - min_angle) / 90), from 0 to 1
enum class Metric : std::uint8_t {
  shape,            ///< 4 sqrt(3) A / (l_min^2 + l_mid^2 + l_max^2), signed; see triangle_quality.h
  area,             ///< A, signed
  min_angle,        ///< smallest interior angle in degrees
  max_angle,        ///< largest interior angle in degrees
  aspect_ratio,     ///< l_max (l_min + l_mid + l_max) / (4 sqrt(3) A)
  radius_ratio,     ///< circumradius / (2 inradius) = l_min l_mid l_max (l_min + l_mid + l_max) / (16 A^2)
  edge_ratio,       ///< l_max / l_min
  condition,        ///< 1 / shape, signed: of the map from the equilateral triangle, in the Frobenius norm, over 2
  scaled_jacobian,  ///< 4 A / (sqrt(3) l_mid l_max), signed: the sine of the smallest angle over that of 60 degrees
  equiangle_skew,   ///< max((max_angle - 60) / 120, (60 - min_angle) / 60), not below 0
  skew,             ///< |cos| of the angle between the lines through the middles of opposite sides, 0 for a rectangle
  taper,            ///< how far opposite sides are from parallel and equal: the distance between the middles of the
                    ///< diagonals over the length of the shorter of these two lines; 0 for a parallelogram
};

/// How many metrics there are.
inline constexpr std::size_t metric_count = 12;

/// What a metric is called, means and ranges over.
struct MetricInfo {
  Metric metric;
  std::string_view name;     ///< as in reports and on the command line
  std::string_view unit;     ///< "degrees", "length^2"; empty for a pure number
  bool larger_is_better;     ///< which end of the range is the good one (for area: inverted triangles are below 0)
  double acceptable_low;     ///< the range that Verdict's manual calls acceptable
  double acceptable_high;    ///< (see is_acceptable)
  double lowest;             ///< the full range, up to rounding; infinite where there is no bound
  double highest;            ///< (of condition, no value lies between -1 and 1)
  std::string_view meaning;  ///< one line for help and reports
};

/// Every metric of elements of that kind, in the order of the enumeration.
[[nodiscard]] std::span<const MetricInfo> all_metrics(ElementKind kind = ElementKind::triangle);

/// What is known of the metric. Throws std::invalid_argument where elements of that kind have none of it.
[[nodiscard]] const MetricInfo& info(Metric metric, ElementKind kind = ElementKind::triangle);

/// The metric of that name which elements of that kind have, or nothing.
[[nodiscard]] std::optional<Metric> metric_named(std::string_view name, ElementKind kind = ElementKind::triangle);

/// "shape, area, ...": the name of every metric of elements of that kind, for messages.
[[nodiscard]] std::string metric_names(ElementKind kind = ElementKind::triangle);

/// What is known of every metric that elements of either kind have, in the order of the enumeration: as triangles have
/// it, of those that they have none of as quadrilaterals do.
[[nodiscard]] const std::array<const MetricInfo*, metric_count>& metrics_of_any_kind();

/// The one of these with that name, or null.
[[nodiscard]] const MetricInfo* find_metric(std::string_view name);

/// True where the value lies in the metric's acceptable range. The ideal end of a range is open: an equilateral
/// triangle is acceptable also where its shape is rounded above 1. Inverted elements are not acceptable by the signed
/// metrics. False for NaN. Throws std::invalid_argument where elements of that kind have none of the metric.
[[nodiscard]] bool is_acceptable(Metric metric, double value, ElementKind kind = ElementKind::triangle);

/// The value of each metric, indexed by Metric; NaN of those that the element has none of.
using MetricValues = std::array<double, metric_count>;

/// The metric of the triangle (a, b, c), whose positive orientation is counter-clockwise.
///
/// The corners are finite and in a frame in which squares of lengths do not overflow (see LocalFrame); area comes in
/// that frame's unit. Where the squares underflow (edges below 1e-162 in that frame) the triangle counts as degenerate,
/// and from edges of 1e-146 down values lose digits.
///
/// A degenerate triangle (area 0, also where corners coincide) has shape, area, scaled_jacobian and min_angle 0,
/// max_angle 180, equiangle_skew 1 and infinite aspect_ratio, radius_ratio and condition; its edge_ratio is infinite
/// where two corners coincide. Ratios of nearly degenerate triangles may overflow to infinity as well. NaN for a metric
/// that is of quadrilaterals alone, never else.
[[nodiscard]] double evaluate(Metric metric, Point2<double> a, Point2<double> b, Point2<double> c);

/// Every metric of the triangle, the same bits as evaluate gives, for about the price of the two angles.
[[nodiscard]] MetricValues evaluate_all(Point2<double> a, Point2<double> b, Point2<double> c);

/// The metric of the quadrilateral (a, b, c, d), corners in turn, whose positive orientation is counter-clockwise. They
/// are in a frame as those of a triangle.
///
/// Where a side has no length, shape and scaled_jacobian are 0 at most and edge_ratio is infinite; there and where the
/// area is 0 min_angle is 0 and max_angle 180 at least. Where the area is 0, aspect_ratio is infinite. skew is 1 and
/// taper infinite where the middles of opposite sides coincide. NaN for a metric that is of triangles alone, never
/// else.
[[nodiscard]] double evaluate(Metric metric, Point2<double> a, Point2<double> b, Point2<double> c, Point2<double> d);

/// Every metric of the quadrilateral, the same bits as evaluate gives, for about the price of the four angles.
[[nodiscard]] MetricValues evaluate_all(Point2<double> a, Point2<double> b, Point2<double> c, Point2<double> d);

}  // namespace trismooth

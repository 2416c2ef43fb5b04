#include "trismooth/quality/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double two_sqrt3 = shape_constant;
constexpr double two_over_sqrt3 = 2 * std::numbers::inv_sqrt3;
constexpr double degrees_per_radian = 180 / std::numbers::pi;

constexpr std::array<MetricInfo, metric_count> metric_table{{
    {Metric::shape, "shape", "", true, 0.25, 1, -1, 1,
     "Lee-Lo quality (mean ratio): 1 equilateral, 0 degenerate, negative inverted"},
    {Metric::area, "area", "length^2", true, 0, std::numeric_limits<double>::max(), -infinity, infinity,
     "area, negative where inverted"},
    {Metric::min_angle, "min_angle", "degrees", true, 30, 60, 0, 60, "smallest interior angle"},
    {Metric::max_angle, "max_angle", "degrees", false, 60, 90, 60, 180, "largest interior angle"},
    {Metric::aspect_ratio, "aspect_ratio", "", false, 1, 1.3, 1, infinity,
     "longest edge over inradius, 1 for equilateral"},
    {Metric::radius_ratio, "radius_ratio", "", false, 1, 3, 1, infinity,
     "circumradius over inradius, 1 for equilateral"},
    {Metric::edge_ratio, "edge_ratio", "", false, 1, 1.3, 1, infinity, "longest edge over shortest edge"},
    {Metric::condition, "condition", "", false, 1, 1.3, -infinity, infinity,
     "condition number of the map from the equilateral triangle, negative where inverted"},
    {Metric::scaled_jacobian, "scaled_jacobian", "", true, 0.5, two_over_sqrt3, -1, 1,
     "sine of the smallest angle over that of 60 degrees: 1 equilateral, negative inverted"},
    {Metric::equiangle_skew, "equiangle_skew", "", false, 0, 0.5, 0, 1,
     "largest deviation of an angle from 60 degrees: 0 equilateral, 1 degenerate"},
}};

struct Edge {
  Point2<double> vector;
  double squared_length;
};

/// A triangle by its edges in order of length, which all metrics but shape are computed from.
struct SortedEdges {
  Edge shortest, middle, longest;  ///< vectors all in one sense of rotation
  double l_min, l_mid, l_max;
  double doubled_area;  ///< not negative
  double sign;          ///< of the orientation, as in shape: -1, 0 or 1

  double perimeter() const { return l_min + l_mid + l_max; }
  bool degenerate() const { return doubled_area == 0; }
};

SortedEdges sort_edges(Point2<double> a, Point2<double> b, Point2<double> c, double signed_shape) {
  Edge shortest{b - a, squared_length(b - a)};
  Edge middle{c - b, squared_length(c - b)};
  Edge longest{a - c, squared_length(a - c)};
  const auto order = [](Edge& shorter, Edge& longer) {
    if (longer.squared_length < shorter.squared_length) {
      std::swap(shorter, longer);
    }
  };
  order(shortest, middle);
  order(middle, longest);
  order(shortest, middle);
  SortedEdges edges{shortest,
                    middle,
                    longest,
                    std::sqrt(shortest.squared_length),
                    std::sqrt(middle.squared_length),
                    std::sqrt(longest.squared_length),
                    0,
                    0};
  // The sign is that of shape, so that the metrics never contradict each other.
  if (signed_shape != 0 && shortest.squared_length != 0) {
    // Of the three corners, the one between the shorter edges loses the fewest digits in needles.
    edges.doubled_area = std::abs(cross(shortest.vector, middle.vector));
    edges.sign = edges.doubled_area == 0 ? 0 : std::copysign(1.0, signed_shape);
  }
  return edges;
}

/// Interior angle between two edges. The arc tangent keeps its digits near 0 and 180 degrees, unlike the arc cosine.
double angle_between(const Edge& one, const Edge& other, double doubled_area) {
  const double dot = -(one.vector.x * other.vector.x + one.vector.y * other.vector.y);
  return std::atan2(doubled_area, dot) * degrees_per_radian;
}

double area(const SortedEdges& edges) {
  return edges.sign * edges.doubled_area / 2;
}

double min_angle(const SortedEdges& edges) {
  return edges.degenerate() ? 0 : angle_between(edges.middle, edges.longest, edges.doubled_area);
}

double max_angle(const SortedEdges& edges) {
  return edges.degenerate() ? 180 : angle_between(edges.shortest, edges.middle, edges.doubled_area);
}

double aspect_ratio(const SortedEdges& edges) {
  return edges.degenerate() ? infinity : edges.l_max * edges.perimeter() / (two_sqrt3 * edges.doubled_area);
}

double radius_ratio(const SortedEdges& edges) {
  // Two quotients, since the fourth powers of short lengths would underflow.
  return edges.degenerate() ? infinity
                            : edges.l_min * edges.l_mid / edges.doubled_area *
                                  (edges.l_max * edges.perimeter() / edges.doubled_area) / 4;
}

double edge_ratio(const SortedEdges& edges) {
  return edges.l_min == 0 ? infinity : edges.l_max / edges.l_min;
}

double condition(double signed_shape) {
  return signed_shape == 0 ? infinity : 1 / signed_shape;
}

double scaled_jacobian(const SortedEdges& edges) {
  return edges.degenerate() ? 0 : edges.sign * two_over_sqrt3 * (edges.doubled_area / (edges.l_mid * edges.l_max));
}

double equiangle_skew(double smallest_angle, double largest_angle) {
  return std::max({0.0, (largest_angle - 60) / 120, (60 - smallest_angle) / 60});
}

}  // namespace

std::span<const MetricInfo> all_metrics() {
  return metric_table;
}

const MetricInfo& info(Metric metric) {
  return metric_table[static_cast<std::size_t>(metric)];
}

std::optional<Metric> metric_named(std::string_view name) {
  const auto* const found = std::find_if(metric_table.begin(), metric_table.end(),
                                         [name](const MetricInfo& candidate) { return candidate.name == name; });
  return found == metric_table.end() ? std::nullopt : std::optional(found->metric);
}

std::string metric_names() {
  std::string names;
  for (const MetricInfo& metric : metric_table) {
    names.append(names.empty() ? "" : ", ").append(metric.name);
  }
  return names;
}

bool is_acceptable(Metric metric, double value) {
  const MetricInfo& range = info(metric);
  return range.larger_is_better ? value >= range.acceptable_low : value >= 0 && value <= range.acceptable_high;
}

double evaluate(Metric metric, Point2<double> a, Point2<double> b, Point2<double> c) {
  const double signed_shape = shape(a, b, c);
  const SortedEdges edges = sort_edges(a, b, c, signed_shape);
  switch (metric) {
    case Metric::shape:
      return signed_shape;
    case Metric::area:
      return area(edges);
    case Metric::min_angle:
      return min_angle(edges);
    case Metric::max_angle:
      return max_angle(edges);
    case Metric::aspect_ratio:
      return aspect_ratio(edges);
    case Metric::radius_ratio:
      return radius_ratio(edges);
    case Metric::edge_ratio:
      return edge_ratio(edges);
    case Metric::condition:
      return condition(signed_shape);
    case Metric::scaled_jacobian:
      return scaled_jacobian(edges);
    case Metric::equiangle_skew:
      break;
  }
  return equiangle_skew(min_angle(edges), max_angle(edges));
}

MetricValues evaluate_all(Point2<double> a, Point2<double> b, Point2<double> c) {
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

}  // namespace trismooth

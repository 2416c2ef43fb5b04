// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/metrics.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "trismooth/base/text/list_text.h"
#include "trismooth/quality/metric_formulas.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/quadrilateral_formulas.h"

namespace trismooth {

namespace {

using metric_formulas::infinity;
using metric_formulas::two_over_sqrt3;

constexpr std::array<MetricInfo, count_of_metrics<CornerPoints>> triangle_metrics{{
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

constexpr std::array<MetricInfo, count_of_metrics<QuadrilateralPoints>> quadrilateral_metrics{{
    {Metric::shape, "shape", "", true, 0.3, 1, -1, 1,
     "worst corner by its sides and angle: 1 square, 0 degenerate, negative not convex"},
    {Metric::area, "area", "length^2", true, 0, std::numeric_limits<double>::max(), -infinity, infinity,
     "area, negative where clockwise"},
    {Metric::min_angle, "min_angle", "degrees", true, 45, 90, 0, 90, "smallest interior angle"},
    {Metric::max_angle, "max_angle", "degrees", false, 90, 135, 90, 360, "largest interior angle"},
    {Metric::aspect_ratio, "aspect_ratio", "", false, 1, 1.3, 1, infinity,
     "longest side times perimeter over four areas, 1 for a square"},
    {Metric::edge_ratio, "edge_ratio", "", false, 1, 1.3, 1, infinity, "longest side over shortest side"},
    {Metric::condition, "condition", "", false, 1, 4, -infinity, infinity,
     "largest condition number at a corner, negative where not convex"},
    {Metric::scaled_jacobian, "scaled_jacobian", "", true, 0.3, 1, -1, 1,
     "smallest sine of an angle: 1 rectangle, negative not convex"},
    {Metric::equiangle_skew, "equiangle_skew", "", false, 0, 0.5, 0, 1,
     "largest deviation of an angle from 90 degrees: 0 rectangle, 1 degenerate or not convex"},
    {Metric::skew, "skew", "", false, 0, 0.5, 0, 1,
     "cosine between the lines through middles of opposite sides: 0 rectangle"},
    {Metric::taper, "taper", "", false, 0, 0.7, 0, infinity, "how unequal opposite sides are: 0 parallelogram"},
}};

const MetricInfo* find_info(Metric metric, ElementKind kind) {
  const auto found = std::ranges::find(all_metrics(kind), metric, &MetricInfo::metric);
  return found == all_metrics(kind).end() ? nullptr : &*found;
}

/// By Metric, from the values of those that the element has.
template <class Points>
MetricValues by_metric(const KindValues<Points>& values) {
  MetricValues all;
  all.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t m = 0; m < values.size(); ++m) {
    all[static_cast<std::size_t>(KindMetrics<Points>::list[m])] = values[m];
  }
  return all;
}

}  // namespace

std::span<const MetricInfo> all_metrics(ElementKind kind) {
  return kind == ElementKind::triangle ? std::span<const MetricInfo>(triangle_metrics)
                                       : std::span<const MetricInfo>(quadrilateral_metrics);
}

const MetricInfo& info(Metric metric, ElementKind kind) {
  const MetricInfo* const found = find_info(metric, kind);
  if (found == nullptr) {
    throw std::invalid_argument("metric: elements of that kind have no such metric");
  }
  return *found;
}

std::optional<Metric> metric_named(std::string_view name, ElementKind kind) {
  const auto found = std::ranges::find(all_metrics(kind), name, &MetricInfo::name);
  return found == all_metrics(kind).end() ? std::nullopt : std::optional(found->metric);
}

std::string metric_names(ElementKind kind) {
  return list_text(all_metrics(kind), &MetricInfo::name);
}

const std::array<const MetricInfo*, metric_count>& metrics_of_any_kind() {
  static const auto metrics = [] {
    std::array<const MetricInfo*, metric_count> found{};
    for (std::size_t m = 0; m < found.size(); ++m) {
      const auto metric = static_cast<Metric>(m);
      const MetricInfo* const of_triangles = find_info(metric, ElementKind::triangle);
      found[m] = of_triangles != nullptr ? of_triangles : find_info(metric, ElementKind::quadrilateral);
    }
    return found;
  }();
  return metrics;
}

const MetricInfo* find_metric(std::string_view name) {
  const auto& metrics = metrics_of_any_kind();
  const auto found = std::ranges::find(metrics, name, &MetricInfo::name);
  return found == metrics.end() ? nullptr : *found;
}

bool is_acceptable(Metric metric, double value, ElementKind kind) {
  return acceptable_range(metric, kind).holds(value);
}

AcceptableRange acceptable_range(Metric metric, ElementKind kind) {
  const MetricInfo& of = info(metric, kind);
  return of.larger_is_better ? AcceptableRange{of.acceptable_low, infinity} : AcceptableRange{0, of.acceptable_high};
}

double evaluate(Metric metric, Point2<double> a, Point2<double> b, Point2<double> c) {
  using namespace metric_formulas;  // NOLINT(google-build-using-namespace): all of them
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
      return equiangle_skew(min_angle(edges), max_angle(edges));
    case Metric::skew:
    case Metric::taper:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

MetricValues evaluate_all(Point2<double> a, Point2<double> b, Point2<double> c) {
  return by_metric<CornerPoints>(metric_formulas::evaluate_all({a, b, c}));
}

double evaluate(Metric metric, Point2<double> a, Point2<double> b, Point2<double> c, Point2<double> d) {
  return evaluate_all(a, b, c, d)[static_cast<std::size_t>(metric)];
}

MetricValues evaluate_all(Point2<double> a, Point2<double> b, Point2<double> c, Point2<double> d) {
  return by_metric<QuadrilateralPoints>(quadrilateral_formulas::evaluate_all({a, b, c, d}));
}

}  // namespace trismooth

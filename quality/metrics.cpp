// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/metrics.h"

#include <algorithm>
#include <limits>

#include "trismooth/base/text/list_text.h"
#include "trismooth/quality/metric_formulas.h"
#include "trismooth/quality/metric_lanes.h"

namespace trismooth {

namespace {

using metric_formulas::infinity;
using metric_formulas::two_over_sqrt3;

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
  return list_text(metric_table, &MetricInfo::name);
}

bool is_acceptable(Metric metric, double value) {
  return acceptable_range(metric).holds(value);
}

AcceptableRange acceptable_range(Metric metric) {
  const MetricInfo& of = info(metric);
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
      break;
  }
  return equiangle_skew(min_angle(edges), max_angle(edges));
}

MetricValues evaluate_all(Point2<double> a, Point2<double> b, Point2<double> c) {
  return metric_formulas::evaluate_all(a, b, c);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/size_ratio.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/metric_lanes.h"

namespace trismooth {

namespace {

constexpr std::int64_t ratio_grain = 1024;

double ratio_of(double a, double b) {
  const double smaller = std::min(a, b);
  return smaller > 0 ? std::max(a, b) / smaller : std::numeric_limits<double>::infinity();
}

template <class Corners>
std::vector<double> areas_of(const ElementView<Corners>& view, Workers& workers) {
  std::vector<double> areas(view.elements.size());
  workers.for_blocks(std::ssize(areas), ratio_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      areas[t] = with_points(view, t, [](const auto& corners) { return std::abs(evaluate(Metric::area, corners)); });
    }
  });
  return areas;
}

template <class Corners>
std::vector<double> ratios_of(const ElementView<Corners>& view, Workers& workers) {
  constexpr std::size_t most_sides = std::tuple_size_v<Corners>;
  const MatchedSides sides = match_sides(static_cast<std::int32_t>(view.points.size()), view.elements, workers);
  const std::vector<double> areas = areas_of(view, workers);
  std::vector<double> ratios(areas.size(), 1);
  workers.for_blocks(std::ssize(ratios), ratio_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      for (std::size_t side = most_sides * t; side < most_sides * (t + 1); ++side) {
        if (const std::int32_t twin = sides.twins[side]; twin >= 0) {
          ratios[t] = std::max(ratios[t], ratio_of(areas[t], areas[static_cast<std::size_t>(twin) / most_sides]));
        }
      }
    }
  });
  return ratios;
}

}  // namespace

std::vector<double> size_ratios(const MeshView& view, int threads) {
  Workers workers(threads);
  return view.visit([&](const auto& elements) { return ratios_of(elements, workers); });
}

MetricSummary size_ratio_summary(const MeshView& view, int threads) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (view.elements.empty()) {
    return {nan, nan, nan, nan, nan};
  }
  const std::vector<double> ratios = size_ratios(view, threads);
  const auto count = static_cast<double>(ratios.size());
  Workers workers(threads);
  const auto sum_of = [&](const auto& value) {
    return ordered_sum(
        std::ssize(ratios), [&](std::int64_t t) { return value(ratios[t]); }, workers);
  };
  const auto [min, max] = std::ranges::minmax(ratios);
  const double mean = sum_of([](double ratio) { return ratio; }) / count;
  const double squares = sum_of([mean](double ratio) { return (ratio - mean) * (ratio - mean); });
  const auto accepted = std::ranges::count_if(ratios, [](double r) { return r <= size_ratio_info.acceptable_high; });
  return {min, mean, max, std::sqrt(squares / count), static_cast<double>(accepted) / count};
}

std::vector<const MetricInfo*> metrics_of(const QualityReport& report) {
  std::vector<const MetricInfo*> metrics;
  const auto add_those_of = [&](ElementKind kind) {
    for (const MetricInfo& metric : all_metrics(kind)) {
      if (std::ranges::find(metrics, metric.metric, &MetricInfo::metric) == metrics.end()) {
        metrics.push_back(&metric);
      }
    }
  };
  if (report.triangles > 0 || report.quadrilaterals == 0) {
    add_those_of(ElementKind::triangle);
  }
  if (report.quadrilaterals > 0) {
    add_those_of(ElementKind::quadrilateral);
  }
  if (report.size_ratio) {
    metrics.push_back(&size_ratio_info);
  }
  return metrics;
}

const MetricSummary& summary_of(const QualityReport& report, const MetricInfo& metric) {
  return metric.name == size_ratio_info.name ? report.size_ratio.value() : report[metric.metric];
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/size_ratio.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/quality/text/quality_table.h"

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::size_ratio_test {

using test_meshes::Mesh;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> ratios_of(const std::vector<Point2<double>>& points, const std::vector<Triangle>& triangles) {
  return size_ratios({points, triangles, {}, 0});
}

/// Equal but for the rounding of areas.
bool are(const std::vector<double>& ratios, const std::vector<double>& expected) {
  return std::ranges::equal(ratios, expected,
                            [](double a, double b) { return a == b || a == Approx(b).epsilon(1e-14); });
}

TEST_CASE("the size ratio is the largest ratio of areas over a side, the larger by the smaller") {
  // From the left: areas 1, 2 and 16; the first and the last share a corner alone.
  const std::vector<Point2<double>> points{{0, 0}, {2, 0}, {0, 1}, {4, 1}, {4, 9}, {9, 9}};
  CHECK(are(ratios_of(points, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}), {2, 8, 8}));
  CHECK(are(ratios_of(points, {{0, 1, 2}, {1, 2, 3}, {4, 2, 3}}), {2, 8, 8}));
  CHECK(are(ratios_of(points, {{0, 1, 2}, {2, 3, 4}}), {1, 1}));
  CHECK(are(ratios_of(points, {{0, 1, 2}}), {1}));
}

TEST_CASE("beside a triangle without area the size ratio is infinite, and where three share a side it is of none") {
  const std::vector<Point2<double>> points{{0, 0}, {2, 0}, {1, 0}, {1, 2}, {1, -1}, {1, 5}};
  CHECK(are(ratios_of(points, {{0, 1, 3}, {1, 0, 2}}), {infinity, infinity}));
  CHECK(are(ratios_of(points, {{0, 1, 3}, {1, 0, 4}, {0, 1, 5}}), {1, 1, 1}));
  // A fold counts by its size.
  CHECK(are(ratios_of(points, {{0, 1, 3}, {1, 0, 5}}), {2.5, 2.5}));
  const MetricSummary summary = size_ratio_summary({points, std::vector<Triangle>{{0, 1, 3}, {1, 0, 2}}, {}, 0});
  CHECK(summary.max == infinity);
  CHECK(summary.acceptable_fraction == 0);
}

TEST_CASE("the size ratios of a mesh are those that all pairs of its triangles say, for any scale and threads") {
  Mesh mesh = test_meshes::jittered_grid(60, 47, 0.4, 11);
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> sides;
  const auto area_of = [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return std::abs(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      sides[std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3])].push_back(t);
    }
  }
  std::vector<double> expected(mesh.triangles.size(), 1);
  for (const auto& [side, triangles] : sides) {
    if (triangles.size() == 2) {
      const double a = area_of(triangles[0]);
      const double b = area_of(triangles[1]);
      for (const std::size_t t : triangles) {
        expected[t] = std::max(expected[t], std::max(a, b) / std::min(a, b));
      }
    }
  }
  const TriangleView view{mesh.points, mesh.triangles, {}, 0};
  const std::vector<double> ratios = size_ratios(view);
  double sum = 0;
  std::size_t accepted = 0;
  for (std::size_t t = 0; t < ratios.size(); ++t) {
    CHECK(ratios[t] == Approx(expected[t]).epsilon(1e-9));
    sum += expected[t];
    accepted += expected[t] <= 2 ? 1 : 0;
  }
  const MetricSummary summary = size_ratio_summary(view, 1);
  CHECK(summary.max == Approx(*std::ranges::max_element(expected)).epsilon(1e-9));
  CHECK(summary.mean == Approx(sum / static_cast<double>(ratios.size())).epsilon(1e-9));
  CHECK(summary.acceptable_fraction == static_cast<double>(accepted) / static_cast<double>(ratios.size()));
  CHECK(summary.mean == size_ratio_summary(view, 3).mean);
  CHECK(summary.stddev == size_ratio_summary(view, 3).stddev);
  for (Point2<double>& point : mesh.points) {
    point = {std::ldexp(point.x, -40), std::ldexp(point.y, -40)};
  }
  CHECK(size_ratios(view, 2) == ratios);
}

TEST_CASE("a mesh without triangles has no size ratio, and reports have it where it was asked for") {
  CHECK(std::isnan(size_ratio_summary({}).max));
  trismooth::QualityReport report;
  CHECK(metrics_of(report).size() == trismooth::all_metrics().size());
  report.size_ratio = MetricSummary{1, 1.25, 7.5, 0.5, 0.75};
  report.triangles = 1;
  CHECK(metrics_of(report).back()->name == "size_ratio");
  CHECK(summary_of(report, *metrics_of(report).back()).max == 7.5);
  CHECK(format_table(report, nullptr).find("\nsize_ratio ") != std::string::npos);
  CHECK(format_table(report, &report).find("\nsize_ratio ") != std::string::npos);
}

}  // namespace trismooth::size_ratio_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quality_report.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tbb/global_control.h>

#include "trismooth/quality/precision_loss.h"
#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "support/same_bits.h"

namespace trismooth::quality_report_test {

using Point = Point2<double>;

struct Mesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> reversed;
  int exponent = 0;

  TriangleView view() const { return {points, triangles, reversed, exponent}; }
};

/// Random triangles over random points, listed in both orientations, `reversed` saying which: some shapes are negative.
Mesh random_mesh(std::size_t triangles, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  constexpr int points = 5000;
  Mesh mesh;
  for (int i = 0; i < points; ++i) {
    const double x = coordinate(random);
    mesh.points.push_back({x, coordinate(random)});
  }
  std::uniform_int_distribution<std::int32_t> corner(0, points - 3);
  while (mesh.triangles.size() < triangles) {
    const std::int32_t first = corner(random);
    const auto& p = mesh.points;
    const auto i = static_cast<std::size_t>(first);
    const bool is_clockwise = shape(p[i], p[i + 1], p[i + 2]) < 0;
    const bool is_folded = random() % 50 == 0;
    mesh.triangles.push_back({first, first + 1, first + 2});
    std::rotate(mesh.triangles.back().begin(), mesh.triangles.back().begin() + random() % 3,
                mesh.triangles.back().end());
    mesh.reversed.push_back(is_clockwise != is_folded ? 1 : 0);
  }
  return mesh;
}

void require_same_bits(const QualityReport& a, const QualityReport& b) {
  REQUIRE(a.triangles == b.triangles);
  REQUIRE(a.inverted == b.inverted);
  REQUIRE(a.shape_histogram == b.shape_histogram);
  for (std::size_t m = 0; m < all_metrics().size(); ++m) {
    const MetricSummary& one = a.metrics[m];
    const MetricSummary& other = b.metrics[m];
    REQUIRE(same_bits(one.min, other.min));
    REQUIRE(same_bits(one.mean, other.mean));
    REQUIRE(same_bits(one.max, other.max));
    REQUIRE(same_bits(one.stddev, other.stddev));
    REQUIRE(same_bits(one.acceptable_fraction, other.acceptable_fraction));
  }
  REQUIRE(a.worst.size() == b.worst.size());
  for (std::size_t i = 0; i < a.worst.size(); ++i) {
    REQUIRE(a.worst[i].element == b.worst[i].element);
    REQUIRE(same_bits(a.worst[i].shape, b.worst[i].shape));
    REQUIRE(same_bits(a.worst[i].centroid.x, b.worst[i].centroid.x));
    REQUIRE(same_bits(a.worst[i].centroid.y, b.worst[i].centroid.y));
  }
}

/// Values of a metric by the plainest loop, from corners in the listed order or its reverse.
std::vector<double> naive_values(const Mesh& mesh, Metric metric) {
  std::vector<double> values;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto [a, b, c] = mesh.triangles[t];
    if (mesh.reversed[t] != 0) {
      std::swap(a, c);
    }
    const auto point = [&](std::int32_t i) { return mesh.points[static_cast<std::size_t>(i)]; };
    values.push_back(evaluate(metric, point(a), point(b), point(c)));
  }
  return values;
}

TEST_CASE("the report agrees with plain loops in extended precision") {
  const Mesh mesh = random_mesh(20000);
  const QualityReport report = quality_report(mesh.view());
  CHECK(report.triangles == 20000);
  for (const MetricInfo& metric : all_metrics()) {
    CAPTURE(std::string(metric.name));
    const std::vector<double> values = naive_values(mesh, metric.metric);
    const auto count = static_cast<long double>(values.size());
    long double sum = 0;
    double acceptable = 0;
    for (const double value : values) {
      sum += value;
      acceptable += is_acceptable(metric.metric, value) ? 1 : 0;
    }
    const long double mean = sum / count;
    long double squares = 0;
    for (const double value : values) {
      squares += (value - mean) * (value - mean);
    }
    const MetricSummary& summary = report[metric.metric];
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    // The corner order differs, so thin triangles' values do in their last digits.
    CHECK(summary.min == Approx(*min).epsilon(1e-9));
    CHECK(summary.max == Approx(*max).epsilon(1e-9));
    CHECK(summary.mean == Approx(static_cast<double>(mean)).epsilon(1e-9));
    CHECK(summary.stddev == Approx(static_cast<double>(std::sqrt(squares / count))).epsilon(1e-9));
    CHECK(summary.acceptable_fraction == Approx(acceptable / static_cast<double>(values.size())).epsilon(1e-15));
  }

  const std::vector<double> shapes = naive_values(mesh, Metric::shape);
  CHECK(report.inverted == std::count_if(shapes.begin(), shapes.end(), [](double value) { return value < 0; }));
  CHECK(report.inverted > 0);
  for (int bin = 0; bin < 20; ++bin) {
    CAPTURE(bin);
    CHECK(report.shape_histogram[static_cast<std::size_t>(bin)] ==
          std::count_if(shapes.begin(), shapes.end(),
                        [bin](double value) { return value >= bin / 20.0 && value < (bin + 1) / 20.0; }));
  }
}

TEST_CASE("the worst elements are those that sorting finds, with their centroids") {
  const Mesh mesh = random_mesh(5000, 2);
  const std::vector<double> shapes = naive_values(mesh, Metric::shape);
  std::vector<std::int64_t> order(shapes.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = static_cast<std::int64_t>(i);
  }
  std::ranges::sort(order, {}, [&](std::int64_t t) { return std::pair(shapes[static_cast<std::size_t>(t)], t); });
  for (const int worst_count : {0, 1, 10, 3000, 100000}) {
    const QualityReport report = quality_report(mesh.view(), {2, worst_count});
    REQUIRE(report.worst.size() == std::min<std::size_t>(static_cast<std::size_t>(worst_count), 5000));
    for (std::size_t i = 0; i < report.worst.size(); ++i) {
      const auto& element = report.worst[i];
      REQUIRE(element.shape == Approx(shapes[static_cast<std::size_t>(order[i])]).margin(1e-12));
      const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(element.element)];
      double x = 0;
      for (const std::int32_t corner : triangle) {
        x += mesh.points[static_cast<std::size_t>(corner)].x / 3;
      }
      REQUIRE(element.centroid.x == Approx(x));
    }
  }
}

TEST_CASE("equally bad elements are listed by index, over the borders of blocks too") {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {0, 1}};
  mesh.triangles.assign(10000, Triangle{0, 1, 2});
  const QualityReport report = quality_report(mesh.view(), {2, 2500});
  REQUIRE(report.worst.size() == 2500);
  for (std::size_t i = 0; i < report.worst.size(); ++i) {
    REQUIRE(report.worst[i].element == static_cast<std::int64_t>(i));
  }
}

TEST_CASE("the number of threads changes no bit") {
  const tbb::global_control more_threads_than_cores(tbb::global_control::max_allowed_parallelism, 8);
  for (const std::size_t triangles : {std::size_t{1}, std::size_t{1024}, std::size_t{1025}, std::size_t{100003}}) {
    CAPTURE(triangles);
    const Mesh mesh = random_mesh(triangles, 3);
    const QualityReport expected = quality_report(mesh.view(), {1, 10});
    const double expected_shape = smallest_shape(mesh.view(), 1);
    CHECK(same_bits(expected_shape, expected[Metric::shape].min));
    for (const int threads : {0, 2, 3, 8, 2}) {
      CAPTURE(threads);
      require_same_bits(quality_report(mesh.view(), {threads, 10}), expected);
      CHECK(same_bits(smallest_shape(mesh.view(), threads), expected_shape));
    }
  }
}

TEST_CASE("the order in which a file lists a triangle's corners changes no bit") {
  Mesh mesh = random_mesh(3000, 4);
  const QualityReport expected = quality_report(mesh.view());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle& triangle = mesh.triangles[t];
    if (t % 2 == 0) {
      std::swap(triangle[0], triangle[1]);
      mesh.reversed[t] ^= 1U;
    } else {
      std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    }
  }
  require_same_bits(quality_report(mesh.view()), expected);
}

TEST_CASE("areas come in units of the file") {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  SECTION("scaled by the square of the length scale") {
    mesh.exponent = 5;
    const MetricSummary area = quality_report(mesh.view())[Metric::area];
    CHECK(area.min == 512);
    CHECK(area.mean == 512);
    CHECK(area.max == 512);
    CHECK(area.stddev == 0);
  }
  SECTION("infinite where the square overflows, and the other metrics untouched") {
    mesh.exponent = 1000;
    const QualityReport report = quality_report(mesh.view());
    CHECK(report[Metric::area].mean == std::numeric_limits<double>::infinity());
    CHECK(report[Metric::shape].mean == Approx(std::numbers::sqrt3 / 2));
  }
}

TEST_CASE("the spread around a large mean loses no digits") {
  // Shapes around 1 that differ in the 8th digit: a one-pass sum of squares would lose all of them.
  Mesh mesh;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> offset(-1e-8, 1e-8);
  long double sum = 0;
  std::vector<double> areas;
  for (std::int32_t i = 0; i < 30000; i += 3) {
    const double height = 1 + offset(random);
    mesh.points.insert(mesh.points.end(), {{0, 0}, {2, 0}, {0, height}});
    mesh.triangles.push_back({i, i + 1, i + 2});
    areas.push_back(height);
    sum += height;
  }
  const long double mean = sum / 10000;
  long double squares = 0;
  for (const double area : areas) {
    squares += (area - mean) * (area - mean);
  }
  const MetricSummary summary = quality_report(mesh.view())[Metric::area];
  CHECK(summary.stddev == Approx(static_cast<double>(std::sqrt(squares / 10000))).epsilon(1e-6));
}

TEST_CASE("shape 1 counts in the last bin, shape 0 in the first, inverted triangles in none") {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {0.5, std::numbers::sqrt3 / 2}, {2, 0}};
  SECTION("equilateral") {
    mesh.triangles = {{0, 1, 2}};
    CHECK(quality_report(mesh.view()).shape_histogram.back() == 1);
  }
  SECTION("degenerate") {
    mesh.triangles = {{0, 1, 3}};
    const QualityReport report = quality_report(mesh.view());
    CHECK(report.shape_histogram.front() == 1);
    CHECK(report.inverted == 0);
    CHECK(report.degenerate == 1);
    CHECK(report[Metric::condition].max == std::numeric_limits<double>::infinity());
  }
  SECTION("inverted") {
    mesh.triangles = {{0, 2, 1}};
    const QualityReport report = quality_report(mesh.view());
    CHECK(report.inverted == 1);
    CHECK(report.degenerate == 0);
    CHECK(std::count(report.shape_histogram.begin(), report.shape_histogram.end(), 0) == 20);
  }
}

TEST_CASE("triangles without area are counted, however many blocks and threads there are") {
  Mesh mesh = random_mesh(5000);
  const auto degenerate = static_cast<std::int32_t>(mesh.points.size());
  // On one point, on one line in either order of corners, and too small for any area to be told.
  mesh.points.insert(mesh.points.end(),
                     {{0.5, 0.5}, {0.5, 0.5}, {0.75, 0.75}, {1, 1}, {0, 0}, {1e-170, 0}, {0, 1e-170}});
  const Triangle offsets[] = {{0, 1, 2}, {0, 2, 3}, {3, 2, 0}, {4, 5, 6}};
  for (std::size_t i = 0; i < 1300; ++i) {
    Triangle triangle = offsets[i % 4];
    for (std::int32_t& corner : triangle) {
      corner += degenerate;
    }
    mesh.triangles.insert(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(3 * i), triangle);
  }
  mesh.reversed.assign(mesh.triangles.size(), 0);
  for (const int threads : {1, 2}) {
    const QualityReport report = quality_report(mesh.view(), {threads, 10});
    CHECK(report.degenerate == 1300);
    std::int64_t others = report.inverted;
    for (const std::int64_t count : report.shape_histogram) {
      others += count;
    }
    CHECK(others == report.triangles);
  }
}

TEST_CASE("a mesh without triangles has NaN for every summary") {
  for (const int threads : {0, 1, 2}) {
    const QualityReport report = quality_report({}, {threads, 10});
    CHECK(report.triangles == 0);
    CHECK(report.inverted == 0);
    CHECK(report.worst.empty());
    for (const MetricSummary& summary : report.metrics) {
      CHECK(std::isnan(summary.min));
      CHECK(std::isnan(summary.mean));
      CHECK(std::isnan(summary.max));
      CHECK(std::isnan(summary.stddev));
      CHECK(std::isnan(summary.acceptable_fraction));
    }
    CHECK(std::isnan(smallest_shape({}, threads)));
  }
}

TEST_CASE("a number of threads that no machine has is refused by every measure of a mesh") {
  const std::vector<Point2<double>> points{{0, 0}, {1, 0}, {0, 1}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  for (const int threads : {-1, 100000, std::numeric_limits<int>::max()}) {
    CHECK_THROWS_AS(quality_report({points, triangles, {}}, {threads, 10}), std::invalid_argument);
    CHECK_THROWS_AS(smallest_shape({points, triangles, {}}, threads), std::invalid_argument);
    CHECK_THROWS_AS(trismooth::single_precision_loss({points, triangles, {}}, threads), std::invalid_argument);
  }
}

}  // namespace trismooth::quality_report_test

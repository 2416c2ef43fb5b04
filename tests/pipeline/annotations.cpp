// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/annotations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/test_meshes.h"

using trismooth::Metric;
using trismooth::metric_annotations;
using trismooth::parse_metrics;
using trismooth::Point2;
using trismooth::Triangle;
using trismooth::TriangleView;
using trismooth::Workers;

TEST_CASE("what annotations are called tells them from a file's own arrays") {
  CHECK(trismooth::annotation_name("shape") == "trismooth:shape");
  CHECK(trismooth::is_annotation("trismooth:anything"));
  for (const char* name : {"shape", "fixed", "displacement", "trismooth", "Trismooth:shape", "a trismooth:shape", ""}) {
    CAPTURE(name);
    CHECK_FALSE(trismooth::is_annotation(name));
  }
}

TEST_CASE("metrics stand at the cells of their triangles, in the file's unit, and are finite") {
  // A right triangle of legs 1, listed clockwise, and one without area. In the file a length is 4 times as much.
  const std::vector<Point2<double>> points{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}};
  const std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}};
  const std::vector<std::uint8_t> reversed{1, 0};
  const std::vector<std::int32_t> cells{2, 0};
  Workers workers(1);
  const std::vector<Metric> metrics{Metric::max_angle, Metric::area, Metric::aspect_ratio, Metric::shape};
  const auto arrays = metric_annotations(metrics, {points, triangles, reversed, 2}, cells, 4, workers, "_before");
  REQUIRE(arrays.size() == 4);
  const auto values = [&](std::size_t i) { return arrays[i].as<double>(); };
  CHECK(arrays[0].name == "trismooth:max_angle_before");
  CHECK(arrays[1].name == "trismooth:area_before");
  for (const auto& array : arrays) {
    CHECK(array.rows() == 4);
    CHECK(array.value(1) == 0);
    CHECK(array.value(3) == 0);
  }
  CHECK(std::abs(values(0)[2] - 90) < 1e-12);
  CHECK(values(0)[0] == 180);
  CHECK(values(1)[2] == 8);
  CHECK(values(1)[0] == 0);
  CHECK(values(2)[0] == 1e30);
  CHECK(std::abs(values(3)[2] - std::sqrt(3) / 2) < 1e-15);
}

TEST_CASE("a strip has the value of its worst triangle, and every number of threads gives the same arrays") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(200, 200, 0.45, 3);
  const TriangleView view{mesh.points, mesh.triangles, {}, 0};
  test_meshes::Random random(5);
  std::vector<std::int32_t> cells;
  for (std::int32_t cell = 1; cells.size() < mesh.triangles.size(); cell += 1 + random.below(2)) {
    // Some longer than what a thread takes at a time.
    const int length = random.below(20) == 0 ? random.below(20'000) : 1 + random.below(9);
    cells.insert(cells.end(), static_cast<std::size_t>(length), cell);
  }
  cells.resize(mesh.triangles.size());
  const auto count = static_cast<std::size_t>(cells.back()) + 2;
  std::map<std::int32_t, double> smallest;
  std::map<std::int32_t, double> largest;
  for (std::size_t t = 0; t < cells.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double shape = trismooth::evaluate(Metric::shape, mesh.points[a], mesh.points[b], mesh.points[c]);
    const double angle = trismooth::evaluate(Metric::max_angle, mesh.points[a], mesh.points[b], mesh.points[c]);
    smallest[cells[t]] = smallest.contains(cells[t]) ? std::min(smallest[cells[t]], shape) : shape;
    largest[cells[t]] = std::max(largest[cells[t]], angle);
  }
  for (const int threads : {1, 2, 3, 7}) {
    CAPTURE(threads);
    Workers workers(threads);
    const auto arrays = metric_annotations(std::vector{Metric::shape, Metric::max_angle}, view, cells, count, workers);
    for (std::size_t cell = 0; cell < count; ++cell) {
      const auto key = static_cast<std::int32_t>(cell);
      REQUIRE(std::abs(arrays[0].value(cell) - (smallest.contains(key) ? smallest[key] : 0)) < 1e-12);
      REQUIRE(std::abs(arrays[1].value(cell) - (largest.contains(key) ? largest[key] : 0)) < 1e-6);
    }
    const auto first = metric_annotations(std::vector{Metric::shape}, view, cells, count, workers);
    CHECK(std::ranges::equal(first[0].bytes, arrays[0].bytes));
  }
}

TEST_CASE("what holds a vertex and how far it moved, by every number of threads") {
  std::vector<std::uint8_t> reasons(50'000);
  std::vector<double> before(3 * reasons.size());
  std::vector<double> after(before.size());
  for (std::size_t v = 0; v < reasons.size(); ++v) {
    reasons[v] = static_cast<std::uint8_t>(v % 7);
    for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
      before[i] = static_cast<double>(v);
      after[i] = before[i] + static_cast<double>(i % 3);
    }
  }
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    const auto fixed = trismooth::fixed_annotation(reasons, workers);
    const auto displacement = trismooth::displacement_annotation(before, after, workers);
    REQUIRE(fixed.rows() == reasons.size());
    REQUIRE(displacement.rows() == reasons.size());
    for (std::size_t v = 0; v < reasons.size(); ++v) {
      REQUIRE(fixed.value(v) == (v % 7 == 0 ? 0 : 1));
      REQUIRE(displacement.value(v, 0) == 0);
      REQUIRE(displacement.value(v, 2) == 2);
    }
  }
}

TEST_CASE("metrics are named in a list, each once") {
  CHECK(parse_metrics("size_ratio,shape").size_ratio);
  CHECK(parse_metrics("size_ratio,shape").metrics == std::vector{Metric::shape});
  CHECK(parse_metrics("size_ratio").metrics.empty());
  CHECK_FALSE(parse_metrics("shape").size_ratio);
  CHECK_THROWS_AS(parse_metrics("size_ratio,size_ratio"), std::invalid_argument);
  CHECK(parse_metrics("shape").metrics == std::vector{Metric::shape});
  CHECK(parse_metrics("min_angle,shape,area").metrics == std::vector{Metric::min_angle, Metric::shape, Metric::area});
  for (const char* text : {"", ",", "shape,", ",shape", "shape min_angle", "shape,,area", "Shape", "shape,shape"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_metrics(text), std::invalid_argument);
  }
  CHECK_THROWS_WITH(parse_metrics("size"), Catch::Contains("'size'") && Catch::Contains("equiangle_skew"));
}

#include "trismooth/pipeline/annotations.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.h"

using trismooth::Metric;
using trismooth::metric_annotations;
using trismooth::parse_metrics;
using trismooth::Point2;
using trismooth::Triangle;

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
  const std::vector<Metric> metrics{Metric::max_angle, Metric::area, Metric::aspect_ratio, Metric::shape};
  const auto arrays = metric_annotations(metrics, {points, triangles, reversed, 2}, cells, 4, "_before");
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

TEST_CASE("metrics are named in a list, each once") {
  CHECK(parse_metrics("shape") == std::vector{Metric::shape});
  CHECK(parse_metrics("min_angle,shape,area") == std::vector{Metric::min_angle, Metric::shape, Metric::area});
  for (const char* text : {"", ",", "shape,", ",shape", "shape min_angle", "shape,,area", "Shape", "shape,shape"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_metrics(text), std::invalid_argument);
  }
  CHECK_THROWS_WITH(parse_metrics("size"), Catch::Contains("'size'") && Catch::Contains("equiangle_skew"));
}

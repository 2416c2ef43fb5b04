// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/metrics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTriangle.h>

#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "support/same_bits.h"

namespace trismooth::metrics_test {

using Point = Point2<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Corners {
  Point a, b, c;
};

class RandomTriangles {
 public:
  explicit RandomTriangles(std::uint64_t seed) : random_(seed) {}
  Corners next() { return {point(), point(), point()}; }

 private:
  Point point() {
    const double x = coordinate_(random_);
    return {x, coordinate_(random_)};
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> coordinate_{-1, 1};
};

double value(Metric metric, const Corners& corners) {
  return evaluate(metric, corners.a, corners.b, corners.c);
}

/// The corners through a map of points.
template <class Map>
Corners mapped(const Corners& corners, const Map& map) {
  return {map(corners.a), map(corners.b), map(corners.c)};
}

constexpr std::array signed_metrics{Metric::shape, Metric::area, Metric::condition, Metric::scaled_jacobian};

bool is_signed(Metric metric) {
  return std::find(signed_metrics.begin(), signed_metrics.end(), metric) != signed_metrics.end();
}

TEST_CASE("every metric agrees with Verdict on random triangles") {
  using VerdictFunction = double (*)(vtkCell*);
  const std::array<std::pair<Metric, VerdictFunction>, 9> verdict{{
      {Metric::shape, &vtkMeshQuality::TriangleShape},
      {Metric::area, &vtkMeshQuality::TriangleArea},
      {Metric::min_angle, &vtkMeshQuality::TriangleMinAngle},
      {Metric::max_angle, &vtkMeshQuality::TriangleMaxAngle},
      {Metric::aspect_ratio, &vtkMeshQuality::TriangleAspectRatio},
      {Metric::radius_ratio, &vtkMeshQuality::TriangleRadiusRatio},
      {Metric::edge_ratio, &vtkMeshQuality::TriangleEdgeRatio},
      {Metric::condition, &vtkMeshQuality::TriangleCondition},
      {Metric::scaled_jacobian, &vtkMeshQuality::TriangleScaledJacobian},
  }};
  vtkNew<vtkTriangle> cell;
  RandomTriangles triangles(1);
  int compared = 0;
  while (compared < 100000) {
    const Corners corners = triangles.next();
    const double signed_shape = value(Metric::shape, corners);
    if (std::abs(signed_shape) < 0.1) {
      continue;
    }
    ++compared;
    cell->GetPoints()->SetPoint(0, corners.a.x, corners.a.y, 0);
    cell->GetPoints()->SetPoint(1, corners.b.x, corners.b.y, 0);
    cell->GetPoints()->SetPoint(2, corners.c.x, corners.c.y, 0);
    for (const auto& [metric, function] : verdict) {
      const double expected = function(cell.GetPointer());
      const double sign = is_signed(metric) && signed_shape < 0 ? -1 : 1;
      const double actual = sign * value(metric, corners);
      if (!(std::abs(actual - expected) < 1e-12 * std::abs(expected))) {
        CAPTURE(std::string(info(metric).name), actual, expected, signed_shape);
        REQUIRE(false);
      }
    }
  }
}

TEST_CASE("equiangle skew follows its formula from angles by the law of cosines") {
  RandomTriangles triangles(2);
  for (int i = 0; i < 100000; ++i) {
    const Corners corners = triangles.next();
    if (std::abs(value(Metric::shape, corners)) < 0.1) {
      continue;
    }
    const double bc = std::hypot(corners.b.x - corners.c.x, corners.b.y - corners.c.y);
    const double ca = std::hypot(corners.c.x - corners.a.x, corners.c.y - corners.a.y);
    const double ab = std::hypot(corners.a.x - corners.b.x, corners.a.y - corners.b.y);
    const auto opposite = [](double across, double one, double other) {
      return std::acos((one * one + other * other - across * across) / (2 * one * other)) * 180 / std::numbers::pi;
    };
    const auto [smallest, largest] = std::minmax({opposite(bc, ca, ab), opposite(ca, ab, bc), opposite(ab, bc, ca)});
    REQUIRE(value(Metric::equiangle_skew, corners) ==
            Approx(std::max((largest - 60) / 120, (60 - smallest) / 60)).margin(1e-12));
  }
}

TEST_CASE("all metrics of triangles worked out by hand") {
  struct Case {
    std::string name;
    Corners corners;
    MetricValues expected;
  };
  const double root3 = std::numbers::sqrt3;
  const double root2 = std::numbers::sqrt2;
  const std::array cases{
      Case{"equilateral of side 2", {{0, 0}, {2, 0}, {1, root3}}, {1, root3, 60, 60, 1, 1, 1, 1, 1, 0}},
      // inradius 1 - 1 / sqrt(2), circumradius 1 / sqrt(2)
      Case{"right isosceles of legs 1",
           {{0, 0}, {1, 0}, {0, 1}},
           {root3 / 2, 0.5, 45, 90, root2 * (2 + root2) / (2 * root3), (root2 + 1) / 2, root2, 2 / root3, root2 / root3,
            0.25}},
      // inradius 1, circumradius 2.5
      Case{"3-4-5",
           {{0, 0}, {3, 0}, {0, 4}},
           {24 * root3 / 50, 6, std::asin(0.6) * 180 / std::numbers::pi, 90, 5 / (2 * root3), 1.25, 5.0 / 3,
            50 / (24 * root3), 1.2 / root3, (60 - std::asin(0.6) * 180 / std::numbers::pi) / 60}},
  };
  for (const Case& one : cases) {
    for (const bool inverted : {false, true}) {
      const Corners corners = inverted ? Corners{one.corners.a, one.corners.c, one.corners.b} : one.corners;
      for (const MetricInfo& metric : all_metrics()) {
        CAPTURE(one.name, inverted, std::string(metric.name));
        const double sign = inverted && is_signed(metric.metric) ? -1 : 1;
        const double expected = sign * one.expected[static_cast<std::size_t>(metric.metric)];
        CHECK(value(metric.metric, corners) == Approx(expected).epsilon(1e-14).margin(1e-15));
      }
    }
  }
}

TEST_CASE("degenerate triangles have the worst value of every metric") {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const std::array cases{
      std::pair<std::string, Corners>{"collinear", {{0, 0}, {1, 1}, {3, 3}}},
      std::pair<std::string, Corners>{"two corners coincide", {{0, 0}, {0, 0}, {3, 1}}},
      std::pair<std::string, Corners>{"all corners coincide", {{2, 3}, {2, 3}, {2, 3}}},
      std::pair<std::string, Corners>{"squares underflow", {{0, 0}, {1e-170, 0}, {0, 1e-170}}},
      std::pair<std::string, Corners>{"smallest possible", {{0, 0}, {tiny, 0}, {0, tiny}}},
  };
  for (const auto& [name, corners] : cases) {
    CAPTURE(name);
    for (const Metric metric : {Metric::shape, Metric::area, Metric::scaled_jacobian, Metric::min_angle}) {
      CHECK(same_bits(value(metric, corners), 0.0));
    }
    CHECK(value(Metric::max_angle, corners) == 180);
    CHECK(value(Metric::equiangle_skew, corners) == 1);
    for (const Metric metric : {Metric::aspect_ratio, Metric::radius_ratio, Metric::condition}) {
      CHECK(value(metric, corners) == infinity);
    }
    CHECK(value(Metric::edge_ratio, corners) == (name == "collinear" ? Approx(3.0) : Approx(infinity)));
  }
}

TEST_CASE("no metric is ever NaN, however thin or small the triangle") {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> power(-1074, 0);
  std::uniform_int_distribution<int> zero(0, 3);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  const auto coordinate = [&] { return zero(random) == 0 ? 0.0 : std::ldexp(mantissa(random), power(random)); };
  const auto point = [&] {
    const double x = coordinate();
    return Point{x, coordinate()};
  };
  for (int i = 0; i < 200000; ++i) {
    const Corners corners{point(), point(), point()};
    const MetricValues values = evaluate_all(corners.a, corners.b, corners.c);
    for (const MetricInfo& metric : all_metrics()) {
      if (std::isnan(values[static_cast<std::size_t>(metric.metric)])) {
        CAPTURE(std::string(metric.name), corners.a.x, corners.a.y, corners.b.x, corners.b.y, corners.c.x, corners.c.y);
        REQUIRE(false);
      }
    }
  }
}

TEST_CASE("angles keep their digits on slivers") {
  for (int power = 1; power <= 15; ++power) {
    const double thickness = std::pow(10.0, -power);
    CAPTURE(thickness);
    const Corners needle{{0, 0}, {1, 0}, {1, thickness}};
    const Corners cap{{0, 0}, {1, 0}, {0.5, thickness}};
    const double degree = 180 / std::numbers::pi;
    CHECK(value(Metric::min_angle, needle) == Approx(std::atan(thickness) * degree).epsilon(1e-14));
    CHECK(value(Metric::max_angle, needle) == Approx(90).epsilon(1e-14));
    CHECK(value(Metric::min_angle, cap) == Approx(std::atan(2 * thickness) * degree).epsilon(1e-14));
    CHECK(180 - value(Metric::max_angle, cap) ==
          Approx(2 * std::atan(2 * thickness) * degree).epsilon(1e-12).margin(1e-13));
  }
}

TEST_CASE("a needle's tip angle does not depend on the corner that comes first") {
  // The long edges round, but the cross product between the short edge and one of them hardly suffers.
  const Corners needle{{0.1, 0.3}, {0.7 + 1e-9, 0.9}, {0.7, 0.9 + 1e-9}};
  const double expected = value(Metric::min_angle, needle);
  CHECK(value(Metric::min_angle, {needle.b, needle.c, needle.a}) == Approx(expected).epsilon(1e-15));
  CHECK(value(Metric::min_angle, {needle.c, needle.a, needle.b}) == Approx(expected).epsilon(1e-15));
}

TEST_CASE("reversal changes the sign of the signed metrics") {
  RandomTriangles triangles(4);
  for (int i = 0; i < 10000; ++i) {
    const Corners corners = triangles.next();
    for (const MetricInfo& metric : all_metrics()) {
      const double forward = value(metric.metric, corners);
      const double backward = value(metric.metric, {corners.a, corners.c, corners.b});
      const double expected = is_signed(metric.metric) ? -forward : forward;
      if (metric.metric == Metric::shape || metric.metric == Metric::condition) {
        REQUIRE(backward == Approx(expected).epsilon(1e-15));  // the sum of squares rounds in another order
      } else {
        REQUIRE(same_bits(backward, expected));
      }
    }
  }
}

TEST_CASE("a power of two and a quarter turn change no bit of a metric but area's exponent") {
  RandomTriangles triangles(5);
  for (int i = 0; i < 10000; ++i) {
    const Corners corners = triangles.next();
    const Corners turned = mapped(corners, [](Point p) { return Point{-p.y, p.x}; });
    for (const MetricInfo& metric : all_metrics()) {
      const double expected = value(metric.metric, corners);
      REQUIRE(same_bits(value(metric.metric, turned), expected));
      for (const int power : {-200, -1, 1, 200}) {
        const Corners scaled = mapped(corners, [power](Point p) {
          return Point{std::ldexp(p.x, power), std::ldexp(p.y, power)};
        });
        REQUIRE(same_bits(value(metric.metric, scaled),
                          metric.metric == Metric::area ? std::ldexp(expected, 2 * power) : expected));
      }
    }
  }
}

TEST_CASE("evaluating all metrics gives the bits of evaluating each, and shape is the one definition's") {
  RandomTriangles triangles(6);
  for (int i = 0; i < 10000; ++i) {
    const Corners corners = triangles.next();
    const MetricValues values = evaluate_all(corners.a, corners.b, corners.c);
    for (const MetricInfo& metric : all_metrics()) {
      REQUIRE(same_bits(values[static_cast<std::size_t>(metric.metric)], value(metric.metric, corners)));
    }
    REQUIRE(same_bits(values[0], shape(corners.a, corners.b, corners.c)));
  }
}

TEST_CASE("every value lies in the metric's full range") {
  RandomTriangles triangles(7);
  for (int i = 0; i < 10000; ++i) {
    const Corners corners = triangles.next();
    for (const MetricInfo& metric : all_metrics()) {
      const double actual = value(metric.metric, corners);
      CAPTURE(std::string(metric.name), actual);
      REQUIRE(actual >= metric.lowest - 1e-12);
      REQUIRE(actual <= metric.highest + 1e-12);
    }
  }
}

TEST_CASE("the metrics are listed in the order of the enumeration and found by name") {
  for (const ElementKind kind : {ElementKind::triangle, ElementKind::quadrilateral}) {
    REQUIRE(std::ranges::is_sorted(all_metrics(kind), {}, &MetricInfo::metric));
    for (const MetricInfo& metric : all_metrics(kind)) {
      CHECK(&info(metric.metric, kind) == &metric);
      CHECK(metric_named(metric.name, kind) == metric.metric);
      CHECK_FALSE(metric.meaning.empty());
    }
  }
  CHECK(metric_named("skew", ElementKind::quadrilateral) == Metric::skew);
  CHECK_FALSE(metric_named("skew").has_value());
  CHECK_FALSE(metric_named("radius_ratio", ElementKind::quadrilateral).has_value());
  CHECK_THROWS_AS(info(Metric::taper), std::invalid_argument);
  CHECK_THROWS_AS(is_acceptable(Metric::radius_ratio, 1, ElementKind::quadrilateral), std::invalid_argument);
  CHECK_FALSE(metric_named("Shape").has_value());
  CHECK_FALSE(metric_named("").has_value());
}

TEST_CASE("acceptable is what Verdict's manual says, open at the ideal end, and never NaN") {
  struct Range {
    Metric metric;
    double low, high;
  };
  for (const Range& range : {Range{Metric::shape, 0.25, 1},
                             {Metric::min_angle, 30, 60},
                             {Metric::max_angle, 60, 90},
                             {Metric::aspect_ratio, 1, 1.3},
                             {Metric::radius_ratio, 1, 3},
                             {Metric::edge_ratio, 1, 1.3},
                             {Metric::condition, 1, 1.3},
                             {Metric::scaled_jacobian, 0.5, 2 / std::numbers::sqrt3},
                             {Metric::equiangle_skew, 0, 0.5}}) {
    const MetricInfo& metric = info(range.metric);
    CAPTURE(std::string(metric.name));
    CHECK(metric.acceptable_low == Approx(range.low));
    CHECK(metric.acceptable_high == Approx(range.high));
    CHECK(is_acceptable(range.metric, (range.low + range.high) / 2));
    const double bad_end = metric.larger_is_better ? range.low : range.high;
    const double worse = metric.larger_is_better ? -infinity : infinity;
    const double ideal_end = metric.larger_is_better ? range.high : range.low;
    CHECK(is_acceptable(range.metric, bad_end));
    CHECK_FALSE(is_acceptable(range.metric, std::nextafter(bad_end, worse)));
    CHECK(is_acceptable(range.metric, std::nextafter(ideal_end, ideal_end == 0 ? 0 : -worse)));
    CHECK_FALSE(is_acceptable(range.metric, std::nan("")));
  }
  CHECK_FALSE(is_acceptable(Metric::condition, -1));
  CHECK(is_acceptable(Metric::area, 0));
  CHECK_FALSE(is_acceptable(Metric::area, -1e-300));
}

}  // namespace trismooth::metrics_test

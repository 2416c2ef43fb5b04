// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkQuad.h>

#include "trismooth/base/errors.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quadrilateral_quality.h"
#include "trismooth/quality/quality.h"

#include "catch.h"
#include "support/limited_instructions.h"
#include "support/mixed_meshes.h"
#include "support/refusal.h"
#include "support/same_bits.h"

namespace trismooth::quadrilaterals_test {

using Point = Point2<double>;
using mixed_meshes::MixedMesh;
using test_support::refusal;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr auto quadrilateral = ElementKind::quadrilateral;

double value(Metric metric, const QuadrilateralPoints& corners) {
  return evaluate(metric, corners[0], corners[1], corners[2], corners[3]);
}

class RandomQuadrilaterals {
 public:
  explicit RandomQuadrilaterals(std::uint64_t seed) : random_(seed) {}
  /// Anything: also such as cross themselves.
  QuadrilateralPoints next() { return {point(), point(), point(), point()}; }
  /// Convex and counter-clockwise, no corner flatter than that.
  QuadrilateralPoints convex(double least_shape) {
    for (;;) {
      const QuadrilateralPoints corners = next();
      if (shape(corners) > least_shape) {
        return corners;
      }
    }
  }

 private:
  Point point() {
    const double x = coordinate_(random_);
    return {x, coordinate_(random_)};
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> coordinate_{-1, 1};
};

TEST_CASE("every metric agrees with Verdict on random convex quadrilaterals") {
  using VerdictFunction = double (*)(vtkCell*);
  const std::array<std::pair<Metric, VerdictFunction>, 10> verdict{{
      {Metric::shape, &vtkMeshQuality::QuadShape},
      {Metric::area, &vtkMeshQuality::QuadArea},
      {Metric::min_angle, &vtkMeshQuality::QuadMinAngle},
      {Metric::max_angle, &vtkMeshQuality::QuadMaxAngle},
      {Metric::aspect_ratio, &vtkMeshQuality::QuadAspectRatio},
      {Metric::edge_ratio, &vtkMeshQuality::QuadEdgeRatio},
      {Metric::condition, &vtkMeshQuality::QuadCondition},
      {Metric::scaled_jacobian, &vtkMeshQuality::QuadScaledJacobian},
      {Metric::skew, &vtkMeshQuality::QuadSkew},
      {Metric::taper, &vtkMeshQuality::QuadTaper},
  }};
  vtkNew<vtkQuad> cell;
  RandomQuadrilaterals quadrilaterals(1);
  for (int compared = 0; compared < 20000; ++compared) {
    const QuadrilateralPoints corners = quadrilaterals.convex(0.05);
    for (vtkIdType i = 0; i < 4; ++i) {
      cell->GetPoints()->SetPoint(i, corners[i].x, corners[i].y, 0);
    }
    for (const auto& [metric, function] : verdict) {
      const double expected = function(cell.GetPointer());
      if (!(std::abs(value(metric, corners) - expected) < 1e-11 * std::max(std::abs(expected), 1e-3))) {
        CAPTURE(std::string(info(metric, quadrilateral).name), value(metric, corners), expected);
        REQUIRE(false);
      }
    }
  }
}

TEST_CASE("all metrics of quadrilaterals worked out by hand") {
  const double root2 = std::numbers::sqrt2;
  const double root5 = std::sqrt(5.0);
  // In the order of all_metrics(): shape, area, min_angle, max_angle, aspect_ratio, edge_ratio, condition,
  // scaled_jacobian, equiangle_skew, skew, taper.
  struct Case {
    std::string name;
    QuadrilateralPoints corners;
    std::array<double, 11> expected;
  };
  const std::array cases{
      Case{"square of side 2", {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}, {1, 4, 90, 90, 1, 1, 1, 1, 0, 0, 0}},
      Case{"the same, clockwise", {{{0, 0}, {0, 2}, {2, 2}, {2, 0}}}, {-1, -4, 90, 90, 1, 1, -1, -1, 0, 0, 0}},
      Case{"rectangle 3 by 1", {{{0, 0}, {3, 0}, {3, 1}, {0, 1}}}, {0.6, 3, 90, 90, 2, 3, 1 / 0.6, 1, 0, 0, 0}},
      Case{"rhombus of 45 degrees",
           {{{0, 0}, {root2, 0}, {1 + root2, 1}, {1, 1}}},
           {1 / root2, root2, 45, 135, root2, 1, root2, 1 / root2, 0.5, 1 / root2, 0}},
      // The short side on top: corners of 45 and 135 degrees, sides 4, sqrt(2), 2, sqrt(2).
      Case{"trapezium",
           {{{0, 0}, {4, 0}, {3, 1}, {1, 1}}},
           {8 / 18.0, 3, 45, 135, 4 * (6 + 2 * root2) / 12, 4 / root2, 18 / 8.0, 1 / root2, 0.5, 0, 1}},
      // Its corner at (1, 1) points inwards, between sides of length 1 at right angles.
      Case{"dart",
           {{{0, 0}, {2, 1}, {1, 1}, {1, 2}}},
           {-1, 1, std::atan2(1.0, 2.0) * 180 / std::numbers::pi, 270, root5 * (2 * root5 + 2) / 4, root5, -1, -1, 1, 0,
            0}},
  };
  for (const Case& sample : cases) {
    CAPTURE(sample.name);
    for (std::size_t m = 0; m < sample.expected.size(); ++m) {
      const Metric metric = all_metrics(quadrilateral)[m].metric;
      if (sample.name == "dart" && (metric == Metric::skew || metric == Metric::taper)) {
        continue;  // compared with Verdict's formulas on convex ones
      }
      CAPTURE(std::string(all_metrics(quadrilateral)[m].name));
      CHECK(value(metric, sample.corners) == Approx(sample.expected[m]).epsilon(1e-14).margin(1e-14));
    }
  }
}

TEST_CASE("a quadrilateral has the same shape to the bit whichever corner comes first, and the negative one mirrored") {
  RandomQuadrilaterals quadrilaterals(3);
  for (int i = 0; i < 20000; ++i) {
    QuadrilateralPoints corners = quadrilaterals.convex(0);
    const double expected = shape(corners);
    for (int turn = 0; turn < 4; ++turn) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      REQUIRE(shape(corners) == expected);
    }
    std::ranges::reverse(corners);
    // The most negative corner counts then, not the worst of the other orientation.
    REQUIRE(shape(corners) <= -expected);
    REQUIRE(value(Metric::area, corners) < 0);
    for (const Metric metric : {Metric::min_angle, Metric::max_angle, Metric::aspect_ratio, Metric::edge_ratio}) {
      const double mirrored = value(metric, corners);
      std::ranges::reverse(corners);
      REQUIRE(mirrored == Approx(value(metric, corners)).epsilon(1e-13));
      std::ranges::reverse(corners);
    }
  }
}

TEST_CASE("a quadrilateral is inverted exactly where one of its corners does not turn to the left") {
  RandomQuadrilaterals quadrilaterals(4);
  int inverted = 0;
  for (int i = 0; i < 50000; ++i) {
    const QuadrilateralPoints corners = quadrilaterals.next();
    bool is_convex = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const Point here = corners[k];
      const Point next = corners[(k + 1) % 4];
      const Point after = corners[(k + 2) % 4];
      is_convex &= (next.x - here.x) * (after.y - next.y) - (next.y - here.y) * (after.x - next.x) > 0;
    }
    inverted += is_convex ? 0 : 1;
    REQUIRE((shape(corners) > 0) == is_convex);
    REQUIRE((value(Metric::scaled_jacobian, corners) > 0) == is_convex);
    REQUIRE((value(Metric::condition, corners) > 0) == is_convex);
  }
  CHECK(inverted > 10000);
}

TEST_CASE("values of quadrilaterals lie in their ranges and are never NaN, where sides have no length too") {
  RandomQuadrilaterals quadrilaterals(5);
  std::mt19937_64 random(6);
  for (int i = 0; i < 50000; ++i) {
    QuadrilateralPoints corners = quadrilaterals.next();
    for (std::uint64_t same = random() % 4; same > 0; --same) {
      corners[random() % 4] = corners[random() % 4];
    }
    if (i % 9 == 0) {
      std::ranges::for_each(corners, [](Point& p) { p.y = 2 * p.x; });
    }
    for (const MetricInfo& metric : all_metrics(quadrilateral)) {
      const double actual = value(metric.metric, corners);
      CAPTURE(std::string(metric.name), actual);
      REQUIRE(actual >= metric.lowest - 1e-12);
      REQUIRE(actual <= metric.highest + 1e-12);
    }
  }
  const QuadrilateralPoints point{};
  CHECK(value(Metric::shape, point) == 0);
  CHECK(value(Metric::min_angle, point) == 0);
  CHECK(value(Metric::max_angle, point) == 180);
  CHECK(value(Metric::edge_ratio, point) == infinity);
  CHECK(value(Metric::skew, point) == 1);
  CHECK(value(Metric::taper, point) == infinity);
  CHECK(std::isnan(value(Metric::radius_ratio, point)));
}

TEST_CASE("metrics of quadrilaterals have the same bits side by side, for every set of instructions") {
  RandomQuadrilaterals quadrilaterals(7);
  std::vector<QuadrilateralPoints> all(1003);
  std::ranges::generate(all, [&] { return quadrilaterals.next(); });
  for (const InstructionSet most : {InstructionSet::baseline, InstructionSet::avx2}) {
    const LimitedInstructions limited(most);
    std::vector<KindValues<QuadrilateralPoints>> values(all.size());
    evaluate_all(all, values);
    for (std::size_t q = 0; q < all.size(); ++q) {
      for (std::size_t m = 0; m < values[q].size(); ++m) {
        CAPTURE(q, m);
        REQUIRE(same_bits(values[q][m], value(all_metrics(quadrilateral)[m].metric, all[q])));
      }
    }
  }
}

TEST_CASE("the report of a mixed mesh sums up the values of its elements, of all and of each kind") {
  const MixedMesh mesh(60, 50, 0.42, 11);
  std::array<std::vector<double>, metric_count> values;
  ElementValues places;
  for (std::size_t m = 0; m < metric_count; ++m) {
    values[m].resize(mesh.elements.size());
    places[m] = values[m];
  }
  const QualityReport report = quality(mesh.points, mesh.elements, places, {.threads = 3, .worst_count = 25});
  const std::vector<double>& shapes = values[static_cast<std::size_t>(Metric::shape)];

  // The values, each by the function of one element.
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto at = [&](std::size_t i) {
      const auto [x, y] = mesh.points[static_cast<std::size_t>(mesh.elements[e][i])];
      return Point{x, y};
    };
    const MetricValues expected =
        mesh.is_triangle(e) ? evaluate_all(at(0), at(1), at(2)) : evaluate_all(at(0), at(1), at(2), at(3));
    for (std::size_t m = 0; m < metric_count; ++m) {
      CAPTURE(e, m);
      REQUIRE(std::isnan(values[m][e]) == std::isnan(expected[m]));
      REQUIRE((std::isnan(expected[m]) || values[m][e] == Approx(expected[m]).epsilon(1e-9)));
    }
  }

  const auto check = [&](const auto& summed, auto&& counts, std::int64_t elements, std::int64_t inverted) {
    std::int64_t expected_elements = 0;
    std::int64_t expected_inverted = 0;
    for (std::size_t m = 0; m < metric_count; ++m) {
      double sum = 0;
      double least = infinity;
      double most = -infinity;
      double acceptable = 0;
      double count = 0;
      for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const double of_element = values[m][e];
        if (!counts(e) || std::isnan(of_element)) {
          continue;
        }
        const auto kind = mesh.is_triangle(e) ? ElementKind::triangle : quadrilateral;
        sum += of_element;
        least = std::min(least, of_element);
        most = std::max(most, of_element);
        acceptable += is_acceptable(static_cast<Metric>(m), of_element, kind) ? 1 : 0;
        count += 1;
      }
      CAPTURE(m);
      const MetricSummary& summary = summed[static_cast<Metric>(m)];
      if (count == 0) {
        CHECK(std::isnan(summary.mean));
        continue;
      }
      CHECK(summary.min == least);
      CHECK(summary.max == most);
      CHECK(summary.mean == Approx(sum / count));
      CHECK(summary.acceptable_fraction == Approx(acceptable / count));
    }
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      expected_elements += counts(e) ? 1 : 0;
      expected_inverted += counts(e) && shapes[e] < 0 ? 1 : 0;
    }
    CHECK(elements == expected_elements);
    CHECK(inverted == expected_inverted);
  };
  check(
      report, [](std::size_t) { return true; }, report.elements(), report.inverted);
  REQUIRE(report.kinds.size() == 2);
  const KindQuality& triangles = report.kinds[0];
  const KindQuality& quadrilaterals = report.kinds[1];
  REQUIRE(triangles.kind == ElementKind::triangle);
  REQUIRE(quadrilaterals.kind == quadrilateral);
  check(
      triangles, [&](std::size_t e) { return mesh.is_triangle(e); }, triangles.elements, triangles.inverted);
  check(
      quadrilaterals, [&](std::size_t e) { return !mesh.is_triangle(e); }, quadrilaterals.elements,
      quadrilaterals.inverted);
  CHECK(report.triangles == triangles.elements);
  CHECK(report.quadrilaterals == quadrilaterals.elements);
  CHECK(quadrilaterals.inverted > 0);

  std::vector<std::size_t> order(shapes.size());
  for (std::size_t e = 0; e < order.size(); ++e) {
    order[e] = e;
  }
  std::ranges::sort(order, {}, [&](std::size_t e) { return std::pair(shapes[e], e); });
  REQUIRE(report.worst.size() == 25);
  for (std::size_t i = 0; i < report.worst.size(); ++i) {
    CHECK(report.worst[i].element == static_cast<std::int64_t>(order[i]));
    CHECK(report.worst[i].shape == shapes[order[i]]);
  }
}

TEST_CASE("triangles given by four numbers have the report of triangles, to the bit") {
  MixedMesh mesh(20, 20, 0.3, 5);
  std::erase_if(mesh.elements, [](const auto& element) { return element[3] >= 0; });
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& [a, b, c, none] : mesh.elements) {
    triangles.push_back({a, b, c});
  }
  const QualityReport expected = quality(mesh.points, triangles);
  const QualityReport found = quality(mesh.points, mesh.elements);
  CHECK(found.triangles == expected.triangles);
  CHECK(found.quadrilaterals == 0);
  CHECK(found.shape_histogram == expected.shape_histogram);
  for (const MetricInfo& metric : all_metrics()) {
    CHECK(same_bits(found[metric.metric].mean, expected[metric.metric].mean));
    CHECK(same_bits(found[metric.metric].stddev, expected[metric.metric].stddev));
  }
  REQUIRE(found.worst.size() == expected.worst.size());
  CHECK(found.worst.front().element == expected.worst.front().element);
}

TEST_CASE("no value depends on how elements are listed or on the number of threads") {
  const MixedMesh mesh(40, 30, 0.25, 21);
  const auto shapes_of = [](const MixedMesh& of, int threads) {
    std::vector<double> shapes(of.elements.size());
    ElementValues places;
    places[static_cast<std::size_t>(Metric::shape)] = shapes;
    static_cast<void>(quality(of.points, of.elements, places, {.threads = threads}));
    return shapes;
  };
  const std::vector<double> expected = shapes_of(mesh, 1);
  CHECK(shapes_of(mesh, 4) == expected);
  const MixedMesh listed = mesh.listed_from_other_corners(2, true);
  CHECK(shapes_of(listed, 2) == expected);
}

TEST_CASE("a quadrilateral that is not convex is inverted and turns none of its neighbours over") {
  // Three squares in a row; the middle one has a corner pushed far inwards, beyond its diagonal.
  const std::vector<std::array<double, 2>> points{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 1}, {1.8, 0.1}, {2, 1}, {3, 1}};
  const std::vector<std::array<int, 4>> elements{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}};
  const QualityReport report = quality(points, elements);
  CHECK(report.inverted == 1);
  CHECK(report.worst.front().element == 1);
  CHECK(report[Metric::shape].max == 1);
  CHECK(report[Metric::max_angle].max > 180);
}

TEST_CASE("what is printed of a mixed mesh has all elements and each kind, of one kind that one alone") {
  const auto printed = [](const QualityReport& report) {
    std::ostringstream text;
    text << report;
    return text.str();
  };
  const MixedMesh mesh(6, 5, 0.2, 1);
  const std::string both = printed(quality(mesh.points, mesh.elements));
  CHECK(both.find("\ntriangles alone\n") != std::string::npos);
  CHECK(both.find("\nquadrilaterals alone\n") != std::string::npos);
  CHECK(both.find("taper") != std::string::npos);
  CHECK(both.find("radius_ratio") != std::string::npos);
  MixedMesh one = mesh;
  std::erase_if(one.elements, [](const auto& element) { return element[3] < 0; });
  const std::string alone = printed(quality(one.points, one.elements));
  CHECK(alone.find("alone") == std::string::npos);
  CHECK(alone.find("triangles") == std::string::npos);
  CHECK(alone.find("radius_ratio") == std::string::npos);
  CHECK(alone.find("quadrilaterals") != std::string::npos);
  CHECK(alone.find(">= 45") != std::string::npos);
}

TEST_CASE("quadrilaterals that are no mesh are refused by their numbers") {
  const std::vector<std::array<double, 2>> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto refused = [&](const std::vector<std::array<int, 4>>& elements) {
    return refusal([&] { static_cast<void>(quality(points, elements)); });
  };
  CHECK(refused({{0, 1, 2, 4}}) == "mesh: element 0 names vertex 4; vertices are numbered from 0 to 3");
  CHECK(refused({{0, 1, 2, 3}, {0, 1, 2, 2}}) ==
        "mesh: element 1 repeats a vertex; of a triangle the last of four numbers is -1");
  std::vector<double> too_few(1);
  ElementValues places;
  places[0] = too_few;
  const std::vector<std::array<int, 4>> two{{0, 1, 2, -1}, {0, 2, 3, -1}};
  CHECK(refusal([&] { static_cast<void>(quality(points, two, places)); }) ==
        "argument: the values of shape: 1 places for 2 elements");
}

}  // namespace trismooth::quadrilaterals_test

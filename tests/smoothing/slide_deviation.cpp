// SPDX-License-Identifier: BSD-3-Clause
// How far a new line is from the old one, against distances between points of both taken densely.

#include "trismooth/smoothing/slide/slide_deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "trismooth/smoothing/slide/slide_chains.h"

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::slide_deviation_test {

using test_meshes::Point;

SlideChains chain_through(const std::vector<Point>& knots, SlideCurve curve) {
  SlideChains chains;
  chains.chains.push_back({0, static_cast<std::int32_t>(knots.size()), 1, false, 0});
  chains.knots = knots;
  chains.curve = curve;
  double arc = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    arc += i > 0 ? std::hypot(knots[i].x - knots[i - 1].x, knots[i].y - knots[i - 1].y) : 0;
    chains.arcs.push_back(arc);
  }
  chains.limits.assign(knots.size(), 1);
  chains.bends.assign(knots.size(), 1);
  return chains;
}

std::vector<Point> wavy_line(test_meshes::Random& random) {
  std::vector<Point> knots;
  double x = 0;
  for (int i = 0; i < 8; ++i) {
    knots.push_back({x, random.between(-0.2, 0.2)});
    x += random.between(0.3, 1);
  }
  return knots;
}

/// The largest distance of points of one polyline from the other, in both directions.
double hausdorff(const std::vector<Point>& first, const std::vector<Point>& second) {
  constexpr int samples = 60;
  const auto sampled = [](const std::vector<Point>& line) {
    std::vector<Point> points;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      for (int s = 0; s <= samples; ++s) {
        const double part = static_cast<double>(s) / samples;
        points.push_back(
            {line[i].x + part * (line[i + 1].x - line[i].x), line[i].y + part * (line[i + 1].y - line[i].y)});
      }
    }
    return points;
  };
  const auto farthest = [](const std::vector<Point>& from, const std::vector<Point>& to) {
    double largest = 0;
    for (const Point p : from) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Point q : to) {
        nearest = std::min(nearest, std::hypot(p.x - q.x, p.y - q.y));
      }
      largest = std::max(largest, nearest);
    }
    return largest;
  };
  const std::vector<Point> a = sampled(first);
  const std::vector<Point> b = sampled(second);
  return std::max(farthest(a, b), farthest(b, a));
}

TEST_CASE("the deviation of an edge is at least the Hausdorff distance to what it replaces, and not much more") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    test_meshes::Random random(seed);
    for (const SlideCurve kind : {SlideCurve::polyline, SlideCurve::spline}) {
      const SlideChains chains = chain_through(wavy_line(random), kind);
      const trismooth::SlideView view = chains.view();
      const ChainCurve curve(view, 0);
      const double end = chains.arcs.back();
      std::array<double, 2> arcs{random.between(0, end), random.between(0, end)};
      std::ranges::sort(arcs);
      const SlidePlace first = curve.at(arcs[0], 0);
      const SlidePlace last = curve.at(arcs[1], 0);
      const Point from = curve.position(first, 0);
      const Point to = curve.position(last, 0);
      double found = 0;
      for_deviations(curve, 0, first, from, last, to, [&](double distance, std::int32_t /*i*/, std::int32_t /*j*/) {
        found = std::max(found, distance);
      });
      std::vector<Point> replaced{curve.on_polyline(first, 0)};
      for (std::int32_t i = first.segment + 1; i <= last.segment; ++i) {
        replaced.push_back(chains.knots[static_cast<std::size_t>(i)]);
      }
      replaced.push_back(curve.on_polyline(last, 0));
      const double expected = hausdorff({from, to}, replaced);
      CAPTURE(seed, to_string(kind), arcs[0], arcs[1]);
      REQUIRE(found >= expected - 0.02);
      REQUIRE(found <= expected + 0.02);
      REQUIRE(trismooth::deviation_share(curve, 0, first, from, last, to) == Approx(found));
    }
  }
}

TEST_CASE("knots have their places to the bit, and a spline is a straight line where its knots are on one") {
  test_meshes::Random random(3);
  const SlideChains wavy = chain_through(wavy_line(random), SlideCurve::spline);
  const trismooth::SlideView wavy_view = wavy.view();
  const ChainCurve curve(wavy_view, 0);
  for (std::int32_t i = 0; i + 1 < std::ssize(wavy.knots); ++i) {
    CHECK(curve.position(curve.at_knot(i), 0) == wavy.knots[static_cast<std::size_t>(i)]);
  }
  const SlideChains straight = chain_through({{0, 1}, {0.3, 1}, {1.7, 1}, {2, 1}}, SlideCurve::spline);
  const trismooth::SlideView straight_view = straight.view();
  const ChainCurve line(straight_view, 0);
  for (double arc = 0; arc < 2; arc += 0.01) {
    CHECK(line.position(line.at(arc, 0), 0).y == 1);
    CHECK(line.position(line.at(arc, 0), 0).x == Approx(arc).margin(1e-12));
  }
}

}  // namespace trismooth::slide_deviation_test

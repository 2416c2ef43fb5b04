// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quadratic_quadrilateral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "trismooth/quality/quadratic_quality.h"

#include "catch.h"
#include "support/quadratic_samples.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::quadratic_quadrilateral_test {

using Node = Point2<double>;
using quadratic_samples::jacobian_of_quad;

Node mean_of(Node a, Node b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/// Of straight sides, with the middles in the middle.
BiquadraticNodes straight(Node a, Node b, Node c, Node d) {
  return {
      a, b, c, d, mean_of(a, b), mean_of(b, c), mean_of(c, d), mean_of(d, a), mean_of(mean_of(a, c), mean_of(b, d))};
}

double jacobian_at(const BiquadraticNodes& nodes, double u, double v, std::size_t count = 9) {
  return jacobian_of_quad(
      count, [&](std::size_t node, std::size_t axis) { return axis == 0 ? nodes[node].x : nodes[node].y; }, u, v);
}

/// The smallest of samples all over the element, and then of ever denser ones around the smallest few so far.
double smallest_sample(const BiquadraticNodes& nodes, std::size_t count = 9) {
  constexpr int steps = 40;
  struct Place {
    double value, u, v;
  };
  std::vector<Place> places;
  const auto sample = [&](double from_u, double from_v, double reach) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps; ++j) {
        const double u = std::clamp(from_u + 2 * reach * i / steps, 0.0, 1.0);
        const double v = std::clamp(from_v + 2 * reach * j / steps, 0.0, 1.0);
        places.push_back({jacobian_at(nodes, u, v, count), u, v});
      }
    }
    const auto kept = places.begin() + std::min<std::ptrdiff_t>(8, std::ssize(places));
    std::partial_sort(places.begin(), kept, places.end(),
                      [](const Place& a, const Place& b) { return a.value < b.value; });
    places.erase(kept, places.end());
  };
  sample(0, 0, 0.5);
  for (double reach = 2.0 / steps; reach > 1e-7; reach /= 8) {
    const std::vector<Place> around(places.begin(), places.end());
    for (const Place& place : around) {
      sample(place.u - reach, place.v - reach, reach);
    }
  }
  return places.front().value;
}

BiquadraticNodes random_nodes(test_meshes::Random& random, double bend) {
  const auto near = [&](double x, double y) {
    return Node{x + random.between(-0.3, 0.3), y + random.between(-0.3, 0.3)};
  };
  BiquadraticNodes nodes = straight(near(0, 0), near(1, 0), near(1, 1), near(0, 1));
  for (std::size_t i = 4; i < 9; ++i) {
    nodes[i] = {nodes[i].x + random.between(-bend, bend), nodes[i].y + random.between(-bend, bend)};
  }
  return nodes;
}

TEST_CASE("a straight quadrilateral has its smallest Jacobian at a corner, a parallelogram the same everywhere") {
  const JacobianBound parallel = jacobian_bound(straight({0, 0}, {1, 0}, {1.5, 0.5}, {0.5, 0.5}));
  CHECK(parallel.straight == 0.5);
  CHECK(parallel.scaled() == 1);
  CHECK(parallel.is_valid());
  CHECK_FALSE(parallel.is_invalid());
  // A trapezoid, 1 and 0.5 wide and 1 high: J is the width at each height.
  const JacobianBound trapezoid = jacobian_bound(straight({0, 0}, {1, 0}, {0.75, 1}, {0.25, 1}));
  CHECK(trapezoid.straight == 0.75);
  CHECK(trapezoid.lowest == Approx(0.5));
  const JacobianBound clockwise = jacobian_bound(straight({0, 0}, {0, 1}, {1, 1}, {1, 0}));
  CHECK(clockwise.is_invalid());
  CHECK(clockwise.scaled() == -1);
  const JacobianBound line = jacobian_bound(straight({0, 0}, {0.25, 0.25}, {0.5, 0.5}, {1, 1}));
  CHECK(line.is_invalid());
  CHECK(line.scaled() == -std::numeric_limits<double>::infinity());
  // Not convex at corner 2.
  CHECK(jacobian_bound(straight({0, 0}, {1, 0}, {0.25, 0.25}, {0, 1})).is_invalid());
}

TEST_CASE("the smallest Jacobian of a quadrilateral is that of ever denser samples of its shape functions") {
  test_meshes::Random random(2);
  int valid = 0;
  int invalid = 0;
  int inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    BiquadraticNodes nodes = random_nodes(random, random.between(0.01, 0.4));
    const std::size_t count = trial % 2 == 0 ? 9 : 8;
    if (count == 8) {
      nodes[8] = centre_of_eight(nodes);
    }
    const JacobianBound bound = jacobian_bound(nodes);
    const double smallest = smallest_sample(nodes, count);
    CAPTURE(trial);
    REQUIRE(std::abs(bound.lowest - smallest) <= bound.rounding + 1e-9);
    REQUIRE(bound.rounding <= 1e-4);
    REQUIRE_FALSE((bound.is_valid() && bound.is_invalid()));
    valid += bound.is_valid() ? 1 : 0;
    invalid += bound.is_invalid() ? 1 : 0;
    double at_corners = std::numeric_limits<double>::infinity();
    for (const double u : {0.0, 1.0}) {
      at_corners = std::min({at_corners, jacobian_at(nodes, u, 0, count), jacobian_at(nodes, u, 1, count)});
    }
    inside += smallest < at_corners - 1e-3 ? 1 : 0;
  }
  CHECK(valid > 100);
  CHECK(invalid > 100);
  CHECK(inside > 100);
}

TEST_CASE(
    "middles at a quarter of their sides at a crack's tip leave an element of eight nodes neither valid nor not") {
  BiquadraticNodes nodes = straight({0.1, 0.2}, {0.9, 0.3}, {1.0, 0.9}, {0.2, 0.8});
  const auto at_quarter = [](Node a, Node b) { return Node{a.x + (b.x - a.x) / 4, a.y + (b.y - a.y) / 4}; };
  nodes[4] = at_quarter(nodes[0], nodes[1]);
  nodes[7] = at_quarter(nodes[0], nodes[3]);
  nodes[8] = centre_of_eight(nodes);
  const JacobianBound at_tip = jacobian_bound(nodes);
  CHECK_FALSE(at_tip.is_valid());
  CHECK_FALSE(at_tip.is_invalid());
  nodes[4].x -= 0.01;
  nodes[8] = centre_of_eight(nodes);
  CHECK(jacobian_bound(nodes).is_invalid());
}

TEST_CASE("where a quadrilateral begins and in which power of two it is measured does not matter") {
  test_meshes::Random random(4);
  for (int trial = 0; trial < 300; ++trial) {
    const BiquadraticNodes nodes = random_nodes(random, 0.2);
    BiquadraticNodes scaled = nodes;
    for (Node& node : scaled) {
      node = {node.x * 0x1p-300, node.y * 0x1p-300};
    }
    const BiquadraticNodes turned{nodes[1], nodes[2], nodes[3], nodes[0], nodes[5],
                                  nodes[6], nodes[7], nodes[4], nodes[8]};
    const JacobianBound bound = jacobian_bound(nodes);
    REQUIRE(same_bits(jacobian_bound(scaled).scaled(), bound.scaled()));
    REQUIRE(jacobian_bound(scaled).is_valid() == bound.is_valid());
    REQUIRE(std::abs(jacobian_bound(turned).lowest - bound.lowest) <= 2 * bound.rounding);
  }
}

TEST_CASE(
    "quadratic elements of both kinds are counted, those listed clockwise in the orientation of their component") {
  // A square of eight nodes, a triangle of six beside it, and a square of nine that is listed clockwise.
  const std::vector<Point2<double>> points{{0, 0},   {1, 0},   {1, 1},   {0, 1},     {0.5, 0},   {1, 0.5},
                                           {0.5, 1}, {0, 0.5}, {2, 0.5}, {1.5, .25}, {1.5, .75}, {0, 2},
                                           {1, 2},   {1, 1.5}, {0.5, 2}, {0, 1.5},   {0.5, 1.5}};
  const std::vector<MixedElement> corners{{0, 1, 2, 3}, {1, 8, 2, no_corner}, {3, 11, 12, 2}};
  const std::vector<QuadraticElement> elements{
      {0, {4, 5, 6, 7, no_corner}}, {1, {9, 10, 5, no_corner, no_corner}}, {2, {15, 14, 13, 6, 16}}};
  const std::vector<std::uint8_t> reversed{0, 0, 1};
  const auto good = quadratic_quality({points, corners, reversed, 0}, elements, 1);
  CHECK(good.elements == 3);
  CHECK(good.quadrilaterals == 2);
  CHECK(good.invalid == 0);
  CHECK(good.min_jacobian == Approx(1));
  CHECK(quadratic_quality({points, corners, {}, 0}, elements, 1).invalid == 1);
  std::vector<Point2<double>> bent = points;
  bent[16] = {0.5, 2.6};  // the centre beyond a side
  CHECK(quadratic_quality({bent, corners, reversed, 0}, elements, 2).invalid == 1);
  bent = points;
  bent[6] = {0.5, 1.9};  // the side between the squares, through both middles
  CHECK(quadratic_quality({bent, corners, reversed, 0}, elements, 2).invalid == 1);
}

}  // namespace trismooth::quadratic_quadrilateral_test

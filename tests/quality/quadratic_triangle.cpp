// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quadratic_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::quadratic_triangle_test {

using Node = Point2<double>;

Node middle_of(Node a, Node b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

QuadraticNodes straight(Node a, Node b, Node c) {
  return {a, b, c, middle_of(a, b), middle_of(b, c), middle_of(c, a)};
}

/// J at barycentric coordinates, from the shape functions of the six nodes: x = sum N x, N of a corner l (2 l - 1), of
/// a middle 4 l l'. It knows nothing of Bernstein coefficients.
double jacobian_at(const QuadraticNodes& nodes, double l1, double l2) {
  const double l0 = 1 - l1 - l2;
  const std::array<double, 6> by_l1{-(4 * l0 - 1), 4 * l1 - 1, 0, 4 * (l0 - l1), 4 * l2, -4 * l2};
  const std::array<double, 6> by_l2{-(4 * l0 - 1), 0, 4 * l2 - 1, -4 * l1, 4 * l1, 4 * (l0 - l2)};
  Node d1{};
  Node d2{};
  for (std::size_t i = 0; i < 6; ++i) {
    d1 = {d1.x + by_l1[i] * nodes[i].x, d1.y + by_l1[i] * nodes[i].y};
    d2 = {d2.x + by_l2[i] * nodes[i].x, d2.y + by_l2[i] * nodes[i].y};
  }
  return d1.x * d2.y - d1.y * d2.x;
}

/// The smallest of samples all over the triangle, and then of ever denser ones around the smallest so far.
double smallest_sample(const QuadraticNodes& nodes) {
  constexpr int steps = 24;
  double smallest = std::numeric_limits<double>::infinity();
  double best1 = 0.5;
  double best2 = 0.5;
  for (double reach = 0.5; reach > 1e-9; reach /= 6) {
    const double from1 = best1 - reach;
    const double from2 = best2 - reach;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps; ++j) {
        const double l1 = std::clamp(from1 + 2 * reach * i / steps, 0.0, 1.0);
        const double l2 = std::clamp(from2 + 2 * reach * j / steps, 0.0, 1 - l1);
        const double value = jacobian_at(nodes, l1, l2);
        if (value < smallest) {
          smallest = value;
          best1 = l1;
          best2 = l2;
        }
      }
    }
  }
  return smallest;
}

QuadraticNodes random_nodes(test_meshes::Random& random, double bend) {
  const auto anywhere = [&] { return Node{random.between(-1, 1), random.between(-1, 1)}; };
  QuadraticNodes nodes = straight(anywhere(), anywhere(), anywhere());
  for (std::size_t i = 3; i < 6; ++i) {
    nodes[i] = {nodes[i].x + random.between(-bend, bend), nodes[i].y + random.between(-bend, bend)};
  }
  return nodes;
}

TEST_CASE("a triangle of straight sides has one Jacobian everywhere") {
  const JacobianBound bound = jacobian_bound(straight({0, 0}, {1, 0}, {0, 0.5}));
  CHECK(bound.straight == 0.5);
  CHECK(bound.lowest == 0.5);
  CHECK(bound.scaled() == 1);
  CHECK(bound.is_valid());
  CHECK_FALSE(jacobian_bound(straight({0, 0}, {0, 0.5}, {1, 0})).is_valid());
  CHECK(jacobian_bound(straight({0, 0}, {0, 0.5}, {1, 0})).scaled() == -1);
  const JacobianBound none = jacobian_bound(straight({0, 0}, {0.5, 0.5}, {1, 1}));
  CHECK_FALSE(none.is_valid());
  CHECK(none.scaled() == -std::numeric_limits<double>::infinity());
}

TEST_CASE("the Jacobian vanishes at the corner where a middle is at a quarter of its side") {
  QuadraticNodes nodes = straight({0, 0}, {1, 0}, {0, 1});
  nodes[3] = {0.25, 0};
  CHECK_FALSE(jacobian_bound(nodes).is_valid());
  nodes[3] = {0.26, 0};
  CHECK(jacobian_bound(nodes).is_valid());
  CHECK(jacobian_bound(nodes).scaled() == Approx(0.04));
}

TEST_CASE("the coefficients are those of the Jacobian of the shape functions") {
  test_meshes::Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const QuadraticNodes nodes = random_nodes(random, 0.5);
    const auto c = trismooth::jacobian_coefficients(nodes);
    for (int sample = 0; sample < 10; ++sample) {
      const double l1 = random.between(0, 1);
      const double l2 = random.between(0, 1 - l1);
      const double l0 = 1 - l1 - l2;
      const double value = c[0] * l0 * l0 + c[1] * l1 * l1 + c[2] * l2 * l2 + 2 * c[3] * l0 * l1 + 2 * c[4] * l1 * l2 +
                           2 * c[5] * l2 * l0;
      REQUIRE(value == Approx(jacobian_at(nodes, l1, l2)).margin(1e-12));
    }
  }
}

TEST_CASE("the smallest Jacobian is the smallest of ever denser samples, at corners, on sides and inside") {
  test_meshes::Random random(2);
  int valid = 0;
  int invalid = 0;
  int below_certificate = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const QuadraticNodes nodes = random_nodes(random, random.between(0.01, 0.4));
    const JacobianBound bound = jacobian_bound(nodes);
    const double smallest = smallest_sample(nodes);
    REQUIRE(bound.lowest <= smallest + bound.rounding);
    REQUIRE(bound.lowest == Approx(smallest).margin(1e-9));
    REQUIRE_FALSE((bound.is_valid() && bound.is_invalid()));
    valid += bound.is_valid() ? 1 : 0;
    invalid += bound.is_invalid() ? 1 : 0;
    const auto c = trismooth::jacobian_coefficients(nodes);
    below_certificate += bound.is_valid() && *std::ranges::min_element(c) < 0 ? 1 : 0;
  }
  CHECK(valid > 300);
  CHECK(invalid > 300);
  CHECK(valid + invalid == 3000);
  CHECK(below_certificate > 0);
}

TEST_CASE("the smallest value of a polynomial that is flat in one direction is found to rounding") {
  // (a l0 + b l1 + c l2)^2 + offset: 0 along a line through the triangle, where elimination has nothing to divide by.
  test_meshes::Random random(3);
  for (int trial = 0; trial < 20'000; ++trial) {
    const double a = random.between(0, 1);
    const double b = -random.between(0, 1);
    const double c = random.between(-1, 1) * (trial % 2 == 0 ? 1 : 1e-9);
    const double tilt = trial % 3 == 0 ? 0 : std::pow(10, random.between(-17, -3));
    const double lowest = trismooth::smallest_value(
        {a * a + tilt, b * b + tilt, c * c + 2 * tilt, a * b + tilt, b * c + tilt, c * a + tilt});
    // The tilt adds tilt (1 + l2^2): the smallest value is between tilt and what it is on side 01.
    REQUIRE(lowest >= tilt - 1e-14);
    REQUIRE(lowest <= tilt + 1e-14);
  }
}

TEST_CASE("an element whose smallest Jacobian is 0 is neither valid nor invalid") {
  QuadraticNodes nodes = straight({0.1, 0.2}, {0.9, 0.3}, {0.3, 0.7});
  const auto at_quarter = [](Node a, Node b) { return Node{a.x + (b.x - a.x) / 4, a.y + (b.y - a.y) / 4}; };
  nodes[3] = at_quarter(nodes[0], nodes[1]);
  nodes[5] = at_quarter(nodes[0], nodes[2]);
  CHECK_FALSE(jacobian_bound(nodes).is_valid());
  CHECK_FALSE(jacobian_bound(nodes).is_invalid());
  CHECK(std::abs(jacobian_bound(nodes).scaled()) < 1e-12);
  nodes[3].x -= 0.01;
  CHECK(jacobian_bound(nodes).is_invalid());
  CHECK(jacobian_bound(straight({0, 0}, {0.5, 0.5}, {1, 1})).is_invalid());
}

TEST_CASE("where the triangle is and in which power of two it is measured does not matter") {
  test_meshes::Random random(4);
  for (int trial = 0; trial < 500; ++trial) {
    const QuadraticNodes nodes = random_nodes(random, 0.2);
    QuadraticNodes scaled = nodes;
    QuadraticNodes turned{nodes[1], nodes[2], nodes[0], nodes[4], nodes[5], nodes[3]};
    for (Node& node : scaled) {
      node = {node.x * 0x1p-300, node.y * 0x1p-300};
    }
    REQUIRE(same_bits(jacobian_bound(scaled).scaled(), jacobian_bound(nodes).scaled()));
    REQUIRE(jacobian_bound(scaled).is_valid() == jacobian_bound(nodes).is_valid());
    const double size = std::abs(jacobian_bound(nodes).straight);
    REQUIRE(jacobian_bound(turned).lowest == Approx(jacobian_bound(nodes).lowest).margin(1e-13 + 1e-12 * size));
  }
}

}  // namespace trismooth::quadratic_triangle_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/quotient_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "trismooth/smoothing/methods/smart_laplacian.h"

#include "catch.h"
#include "support/random_rings.h"
#include "support/test_meshes.h"

namespace trismooth::quotient_filter_test {

using Point = Point2<double>;

struct Ring : random_rings::QuadrilateralRingOf<double> {};

/// As that of other rings, of quadrilaterals alone.
template <class NodeAt, class Visit>
void for_elements_around(const Ring& ring, const NodeAt& node, const Visit& visit) {
  const int size = ring.size();
  for (int i = 0; i < size; ++i) {
    visit(QuadrilateralCorner<decltype(node(0))>{node(i), node(size + i), node((i + 1) % size)});
  }
}

struct Move {
  Point position;
  Point target;
  Ring ring;
};

double tiny(test_meshes::Random& random) {
  return std::ldexp(random.between(-1, 1), -random.below(60));
}

Point point_near(Point centre, double distance, test_meshes::Random& random) {
  return {centre.x + distance * random.between(-1, 1), centre.y + distance * random.between(-1, 1)};
}

/// Around the origin. `disorder`: how far vertices are off their places in an even ring.
Ring ring_of(int size, double disorder, test_meshes::Random& random) {
  Ring ring;
  for (int i = 0; i < 2 * size; ++i) {
    const bool is_opposite = i >= size;
    const double angle = 2 * std::numbers::pi * (i + (is_opposite ? 0.5 : 0)) / size;
    const double radius = is_opposite ? 2 * std::cos(std::numbers::pi / size) : 1;
    ring.positions.push_back(point_near({radius * std::cos(angle), radius * std::sin(angle)}, disorder, random));
  }
  return ring;
}

/// What is easy to tell.
Move ordinary(test_meshes::Random& random) {
  return {point_near({0, 0}, 0.2, random), point_near({0, 0}, 0.2, random), ring_of(3 + random.below(4), 0.1, random)};
}

/// What is hard to tell, or broken: quality that hardly changes or is the same, elements inverted and degenerate, all
/// scales, and what is no number.
Move difficult(test_meshes::Random& random) {
  Move move = ordinary(random);
  const int size = move.ring.size();
  const int kind = random.below(6);
  if (kind == 0) {
    move.target = point_near(move.position, tiny(random), random);
  } else if (kind == 1) {
    // The same on the other side of a ring that is its own mirror image, or nearly.
    move.ring = ring_of(size, 0, random);
    for (int i = 0; i < size; ++i) {
      move.ring.positions[i].x += i == 0 ? tiny(random) : 0;
      const int other = (size - i) % size;
      move.ring.positions[other] = {move.ring.positions[i].x, -move.ring.positions[i].y};
      move.ring.positions[size + (size - 1 - i)] = {move.ring.positions[size + i].x, -move.ring.positions[size + i].y};
    }
    move.target = {move.position.x, -move.position.y * (random.below(2) == 0 ? 1 : 1 + tiny(random) * tiny(random))};
  } else if (kind == 2) {
    move.ring = ring_of(size, 1.5, random);
  } else if (kind == 3) {
    const Point place = random.below(2) == 0 ? move.position : move.ring.positions[random.below(2 * size)];
    for (int count = random.below(2 * size); count >= 0; --count) {
      move.ring.positions[random.below(2 * size)] = place;
    }
  } else if (kind == 4) {
    // Few coordinates: sides in line, and corners at one place.
    for (Point& point : move.ring.positions) {
      point = {random.below(3) - 1.0, random.below(3) - 1.0};
    }
  } else {
    const double values[]{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), 0};
    move.ring.positions[random.below(2 * size)].x = values[random.below(5)];
  }
  if (random.below(2) == 0) {
    const double scale = std::ldexp(1, random.below(4) == 0 ? random.below(2040) - 1020 : -random.below(180));
    const auto scaled = [&](Point point) { return Point{scale * point.x, scale * point.y}; };
    std::ranges::transform(move.ring.positions, move.ring.positions.begin(), scaled);
    move.position = scaled(move.position);
    move.target = scaled(move.target);
  }
  return move;
}

TEST_CASE("what the filter of smart moves says in quadrilaterals is what the quotients say, however hard to tell") {
  test_meshes::Random random(5);
  int better = 0;
  int worse = 0;
  int undecided = 0;
  for (int trial = 0; trial < 1000000; ++trial) {
    const Move move = difficult(random);
    const auto [gain, band] = trismooth::quotient_filter::gain(move.position, move.target, move.ring);
    const double before = trismooth::worst_quotient(move.position, move.ring);
    const bool is_better = trismooth::is_better_than(before, move.target, move.ring);
    const bool is_right = gain > band ? is_better && before >= 0 : !(gain < -band) || !is_better;
    if (!is_right) {
      CAPTURE(trial, gain, band, before, is_better);
      REQUIRE(is_right);
    }
    ++(gain > band ? better : gain < -band ? worse : undecided);
  }
  CHECK(better > 10000);
  CHECK(worse > 10000);
  CHECK(undecided > 10000);
}

TEST_CASE("the filter of smart moves decides what is easy to tell in quadrilaterals") {
  test_meshes::Random random(6);
  int better = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Move move = ordinary(random);
    const auto [gain, band] = trismooth::quotient_filter::gain(move.position, move.target, move.ring);
    const double before = trismooth::worst_quotient(move.position, move.ring);
    const double after = trismooth::worst_quotient(move.target, move.ring);
    if (before > 0 && std::abs(after - before) > 1e-12) {
      REQUIRE((gain > band) == (after > before));
      REQUIRE((gain < -band) == (after < before));
      better += after > before ? 1 : 0;
    }
  }
  CHECK(better > 20000);
}

}  // namespace trismooth::quotient_filter_test

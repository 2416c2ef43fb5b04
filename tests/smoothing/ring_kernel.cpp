// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/ring_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::ring_kernel_test {

using Ring = std::vector<Point2<double>>;

/// `least`: what is seen of every edge is more than this.
bool sees_all(const Ring& ring, Point2<double> p, double least = 0) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!(cross(ring[i] - p, ring[(i + 1) % ring.size()] - p) > least)) {
      return false;
    }
  }
  return true;
}

/// Some are folded, some see all of themselves from somewhere.
Ring random_ring(test_meshes::Random& random) {
  const std::int32_t size = 3 + random.below(8);
  Ring ring;
  for (std::int32_t i = 0; i < size; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.between(-1.2, 1.2)) / size;
    const double radius = random.between(0.2, 1);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

TEST_CASE("a vertex in the centre of a ring's kernel has valid triangles alone, and there is a centre where any has") {
  test_meshes::Random random(1);
  std::vector<Point2<double>> scratch;
  int with_kernel = 0;
  int without = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ring ring = random_ring(random);
    const auto centre = kernel_centre(ring, scratch);
    if (centre) {
      REQUIRE(sees_all(ring, *centre));
      ++with_kernel;
      continue;
    }
    ++without;
    for (int tries = 0; tries < 200; ++tries) {
      const double x = random.between(-1, 1);
      REQUIRE_FALSE(sees_all(ring, {x, random.between(-1, 1)}));
    }
  }
  CHECK(with_kernel > 500);
  CHECK(without > 500);
}

TEST_CASE("a ring that goes round clockwise has no kernel") {
  std::vector<Point2<double>> scratch;
  CHECK(kernel_centre(Ring{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, scratch) == Point2<double>{0.5, 0.5});
  CHECK_FALSE(kernel_centre(Ring{{0, 0}, {0, 1}, {1, 1}, {1, 0}}, scratch));
}

/// A ring in which some elements are quadrilaterals: their opposite vertices are in the polygon, and chords cut these
/// off.
struct MixedRing {
  Ring polygon;
  std::vector<Chord> chords;
};

MixedRing random_mixed_ring(test_meshes::Random& random) {
  const Ring ring = random_ring(random);
  MixedRing mixed;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2<double> next = ring[(i + 1) % ring.size()];
    mixed.polygon.push_back(ring[i]);
    if (random.below(2) == 0) {
      const double out = random.between(0.7, 1.4);
      mixed.polygon.push_back({out * (ring[i].x + next.x) / 2, out * (ring[i].y + next.y) / 2});
      mixed.chords.push_back({ring[i], next});
    }
  }
  return mixed;
}

bool is_left_of_chords(const MixedRing& ring, Point2<double> p, double least = 0) {
  return std::ranges::all_of(ring.chords,
                             [&](const Chord& chord) { return cross(chord[0] - p, chord[1] - p) > least; });
}

TEST_CASE("in the centre of a kernel with chords a vertex has no inward corner, nor its neighbours beside it") {
  test_meshes::Random random(3);
  std::vector<Point2<double>> scratch;
  int with_kernel = 0;
  int without = 0;
  for (int i = 0; i < 2000; ++i) {
    const MixedRing ring = random_mixed_ring(random);
    if (const auto centre = kernel_centre(ring.polygon, scratch, ring.chords)) {
      // Where a chord meets an edge the kernel may be no more than that point.
      constexpr double rounding = -1e-14;
      REQUIRE(sees_all(ring.polygon, *centre, rounding));
      REQUIRE(is_left_of_chords(ring, *centre, rounding));
      with_kernel += sees_all(ring.polygon, *centre) && is_left_of_chords(ring, *centre) ? 1 : 0;
      continue;
    }
    ++without;
    for (int tries = 0; tries < 200; ++tries) {
      const double x = random.between(-1, 1);
      const Point2<double> place{x, random.between(-1, 1)};
      REQUIRE_FALSE((sees_all(ring.polygon, place) && is_left_of_chords(ring, place)));
    }
  }
  CHECK(with_kernel > 300);
  CHECK(without > 300);
}

TEST_CASE("a ring that is turned by right angles has the same centre, turned, to the last bit") {
  test_meshes::Random random(2);
  std::vector<Point2<double>> scratch;
  int with_kernel = 0;
  for (int i = 0; i < 2000; ++i) {
    Ring ring = random_ring(random);
    if (i % 3 == 0) {
      ring[1] = ring[0];  // an edge without a direction
    }
    if (i % 4 == 0) {
      ring[2] = {ring[2].x, ring[1].y};  // and one along an axis
    }
    auto expected = kernel_centre(ring, scratch);
    for (int turns = 0; turns < 3; ++turns) {
      for (Point2<double>& p : ring) {
        p = {-p.y, p.x};
      }
      const auto found = kernel_centre(ring, scratch);
      REQUIRE(found.has_value() == expected.has_value());
      if (found) {
        expected = Point2<double>{-expected->y, expected->x};
        REQUIRE(*found == *expected);
        ++with_kernel;
      }
    }
  }
  CHECK(with_kernel > 1000);
}

}  // namespace trismooth::ring_kernel_test

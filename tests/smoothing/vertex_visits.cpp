// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/vertex_visits.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "trismooth/smoothing/methods/methods.h"

#include "catch.h"
#include "support/limited_instructions.h"
#include "support/random_rings.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::vertex_visits_test {

constexpr int difficulties = 7;
constexpr int nearly_even = 6;

/// From 1 down to what rounding leaves of it.
double tiny(test_meshes::Random& random) {
  return std::ldexp(random.between(-1, 1), -random.below(60));
}

/// Neighbours of a vertex at the origin or beside it: of one kind of difficulty.
template <class T>
std::vector<Point2<T>> star(int size, int kind, test_meshes::Random& random) {
  std::vector<Point2<T>> ring;
  constexpr int most = std::numeric_limits<T>::max_exponent - 4;
  const double scale = kind == 3 ? std::ldexp(1.0, random.below(2 * most) - most) : 1;
  for (int k = 0; k < size; ++k) {
    const double disorder = kind == 1 ? 2 : kind == nearly_even ? tiny(random) : 0.4;  // tangled, or not
    const double angle = 2 * std::numbers::pi * (k + disorder * random.between(-1, 1)) / size;
    const double radius = kind == 2 || kind == nearly_even ? 1 : random.between(0.4, 1.6);
    ring.push_back(
        {static_cast<T>(scale * radius * std::cos(angle)), static_cast<T>(scale * radius * std::sin(angle))});
  }
  if (kind == 4) {  // degenerate: some at one place, or none
    ring[random.below(size)] = ring[0];
    ring[random.below(size)] = {0, 0};
  }
  if (kind == 5) {  // beyond all numbers
    ring[random.below(size)].x = std::numeric_limits<T>::max();
    ring[random.below(size)].y = random.below(2) == 0 ? std::numeric_limits<T>::quiet_NaN() : T(-1);
  }
  return ring;
}

/// Vertices with rings of their own, all of one size and kind.
template <class T>
struct Stars {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> opposites;  ///< of quadrilaterals
  std::vector<Point2<T>> points;

  Stars(int count, int size, RingKind kind, test_meshes::Random& random) {
    for (int v = 0; v < count; ++v) {
      const bool is_centre = random.below(4) == 0;
      points.push_back({is_centre ? T(0) : static_cast<T>(random.between(-0.3, 0.3)),
                        is_centre ? T(0) : static_cast<T>(random.between(-0.3, 0.3))});
    }
    for (int v = 0; v < count; ++v) {
      const int difficulty = random.below(difficulties);
      if (difficulty == nearly_even) {
        points[v] = {static_cast<T>(tiny(random)), static_cast<T>(tiny(random))};
      }
      for (const Point2<T> point : star<T>(size, difficulty, random)) {
        neighbours.push_back(static_cast<std::int32_t>(points.size()));
        points.push_back(point);
      }
      for (int k = 0; k < size && kind == RingKind::quadrilaterals; ++k) {
        // The far corner of a parallelogram, or nearly.
        const auto first = neighbours.end() - size;
        const Point2<T> a = points[first[k]];
        const Point2<T> b = points[first[(k + 1) % size]];
        const auto stretch = difficulty == nearly_even ? T(1) : static_cast<T>(random.between(0.7, 1.2));
        opposites.push_back(static_cast<std::int32_t>(points.size()));
        points.push_back({stretch * (a.x + b.x), stretch * (a.y + b.y)});
      }
      offsets.push_back(static_cast<std::int64_t>(neighbours.size()));
    }
  }
  RingView rings() const { return {offsets, neighbours, {}, opposites}; }
  /// What the method says of a vertex by itself.
  template <class Method>
  VertexMove<T> alone(const Method& method, std::int32_t v) const {
    const auto of_ring = [&](auto ring) {
      rings().for_vertices_around(v, [&](std::int32_t other) { ring.positions.push_back(points[other]); });
      return trismooth::update_over(method, v, points[v], ring);
    };
    return opposites.empty() ? of_ring(random_rings::RingOf<T>{}) : of_ring(random_rings::QuadrilateralRingOf<T>{});
  }
};

/// Visits side by side, against each by itself.
template <class T, class Update>
void check_visits(const Update& method) {
  for (const InstructionSet most : {InstructionSet::baseline, InstructionSet::avx2}) {
    const LimitedInstructions limited(most);
    test_meshes::Random random(23);
    int moved = 0;
    int stayed = 0;
    for (int trial = 0; trial < 1500; ++trial) {
      const int size = 3 + trial % 10;
      const int count = 1 + random.below(70);
      const RingKind kind = trial % 3 == 0 ? RingKind::quadrilaterals : RingKind::triangles;
      const Stars<T> stars(count, size, kind, random);
      const RingView rings = stars.rings();
      std::vector<std::int32_t> vertices(static_cast<std::size_t>(count));
      std::iota(vertices.begin(), vertices.end(), 0);
      std::vector<VertexMove<T>> found(vertices.size());
      trismooth::VertexVisits<T, Update> visits(method, rings, stars.points);
      visits.visit(vertices, size, kind, [&](std::int32_t v, Point2<T> target, T squares) {
        REQUIRE(!found[v].move.moved);
        found[v] = {{target, true}, squares};
      });
      for (const std::int32_t v : vertices) {
        CAPTURE(trial, size, count, v);
        const VertexMove<T> alone = stars.alone(method, v);
        REQUIRE(found[v].move.moved == alone.move.moved);
        if (alone.move.moved) {
          REQUIRE(same_bits(found[v].move.position.x, alone.move.position.x));
          REQUIRE(same_bits(found[v].move.position.y, alone.move.position.y));
          REQUIRE(same_bits(found[v].squares, alone.squares));
        }
        ++(alone.move.moved ? moved : stayed);
      }
    }
    CHECK(moved > 1000);
    CHECK(stayed > 1000);
  }
}

TEMPLATE_TEST_CASE("vertices that are visited side by side get the bits that each gets alone, by all instructions", "",
                   float, double) {
  for (const Method method : values_of<Method>()) {
    CAPTURE(to_string(method));
    visit_method(MethodInUse<TestType>{method}, []<class Update>(const Update& update) {
      if constexpr (requires { Update::is_smart; }) {
        check_visits<TestType>(update);
      }
    });
  }
}

}  // namespace trismooth::vertex_visits_test

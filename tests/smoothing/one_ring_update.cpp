// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/methods/one_ring_update.h"

#include <cstddef>
#include <limits>

#include "trismooth/smoothing/methods/methods.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/random_rings.h"

namespace trismooth::one_ring_update_test {

using random_rings::RingOf;

TEMPLATE_TEST_CASE("the Laplacian position is the sum in ring order times 1/k, bit for bit", "", float, double) {
  test_meshes::Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const RingOf<TestType> ring = random_rings::any<TestType>(random);
    const Point2<TestType> expected = naive::laplacian(ring.positions);
    const Point2<TestType> found = trismooth::laplacian_position<TestType>(ring);
    REQUIRE(found.x == expected.x);
    REQUIRE(found.y == expected.y);
  }
  // Not the sum divided by k: three times 1 by 3 shows it where k = 3 is not a power of two.
  const RingOf<TestType> ring{{{5, 0}, {0, 0}, {0, 0}}};
  CHECK(trismooth::laplacian_position<TestType>(ring).x == 5 * (1 / TestType(3)));
}

TEMPLATE_TEST_CASE("the order of the ring matters to the last bit, and it is kept", "", float, double) {
  const TestType large = 1 / std::numeric_limits<TestType>::epsilon();
  const RingOf<TestType> lost{{{2 * large, 0}, {1, 0}, {-2 * large, 0}, {0, 0}}};
  const RingOf<TestType> kept{{{2 * large, 0}, {-2 * large, 0}, {1, 0}, {0, 0}}};
  CHECK(trismooth::laplacian_position<TestType>(lost).x == 0);
  CHECK(trismooth::laplacian_position<TestType>(kept).x == TestType(0.25));
}

TEST_CASE("a move is one to another finite point only") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  const Point2<double> here{1, 2};
  CHECK(move_to(here, {1, 3}).moved);
  CHECK(move_to(here, {1, 3}).position == Point2<double>{1, 3});
  CHECK_FALSE(move_to(here, here).moved);
  CHECK_FALSE(move_to(Point2<double>{0.0, 0.0}, Point2<double>{-0.0, 0.0}).moved);
  for (const double bad : {infinite, -infinite, no_number}) {
    for (const Point2<double> target : {Point2<double>{bad, 0}, Point2<double>{0, bad}, Point2<double>{bad, bad}}) {
      CHECK_FALSE(move_to(here, target).moved);
      CHECK(move_to(here, target).position == here);
    }
  }
}

/// Calls `function` with the update of every method that knows the ring alone.
template <class Function>
void for_updates_by_ring(const Function& function) {
  for (const Method method : values_of<Method>()) {
    CAPTURE(to_string(method));
    visit_method(MethodInUse<double>{method}, [&]<class Update>(const Update& update) {
      if constexpr (requires { Update::is_smart; }) {
        function(update);
      }
    });
  }
}

TEST_CASE("no method moves a vertex where a position is no number or infinite") {
  for_updates_by_ring([]<class Update>(const Update& /*update*/) {
    test_meshes::Random random(2);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (int i = 0; i < 500; ++i) {
        RingOf<double> ring = random_rings::any<double>(random);
        const Point2<double> here{random.between(-1, 1), random.between(-1, 1)};
        const auto which = static_cast<std::size_t>(random.below(ring.size()));
        (random.below(2) == 0 ? ring.positions[which].x : ring.positions[which].y) = bad;
        const auto move = Update::template update<double>(here, ring);
        REQUIRE_FALSE(move.moved);
        REQUIRE(move.position == here);
      }
    }
  });
}

TEST_CASE("no method that looks at the vertex itself moves one that is nowhere") {
  for_updates_by_ring([]<class Update>(const Update& /*update*/) {
    if (!Update::is_smart) {
      return;
    }
    test_meshes::Random random(3);
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 500; ++i) {
      const RingOf<double> ring = random_rings::any<double>(random);
      REQUIRE_FALSE(Update::template update<double>({no_number, 0}, ring).moved);
      REQUIRE_FALSE(Update::template update<double>({0, no_number}, ring).moved);
    }
  });
}

}  // namespace trismooth::one_ring_update_test

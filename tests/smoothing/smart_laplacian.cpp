// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/methods/smart_laplacian.h"

#include <vector>

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/random_rings.h"

namespace trismooth::smart_laplacian_test {

using random_rings::RingOf;

TEMPLATE_TEST_CASE("the quotients around a vertex are those of its triangles, evaluated from the vertex", "", float,
                   double) {
  test_meshes::Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const RingOf<TestType> ring = random_rings::any<TestType>(random);
    const Point2<TestType> here{static_cast<TestType>(random.between(-1, 1)),
                                static_cast<TestType>(random.between(-1, 1))};
    std::vector<TestType> expected;
    for (int n = 0; n < ring.size(); ++n) {
      expected.push_back(naive::quotient(here, ring[n], ring[(n + 1) % ring.size()]));
    }
    std::vector<TestType> found;
    for_ring_quotients(here, ring, [&](TestType quotient) { found.push_back(quotient); });
    REQUIRE(found == expected);
    REQUIRE(worst_quotient(here, ring) == naive::smallest_quotient(here, ring.positions));
    REQUIRE(inverted_triangles(here, ring) == naive::inverted(here, ring.positions));
  }
}

TEMPLATE_TEST_CASE(
    "a vertex moves to its mean if and only if the smallest quotient gets strictly larger and no more "
    "triangles are inverted",
    "", float, double) {
  test_meshes::Random random(2);
  int moved = 0;
  int held_by_quality = 0;
  int held_by_count = 0;
  for (int i = 0; i < 30000; ++i) {
    const RingOf<TestType> ring = random_rings::any<TestType>(random);
    const double reach = random.below(2) == 0 ? 0.5 : 2;
    const Point2<TestType> here{static_cast<TestType>(random.between(-reach, reach)),
                                static_cast<TestType>(random.between(-reach, reach))};
    const Point2<TestType> mean = naive::laplacian(ring.positions);
    const bool better = naive::smallest_quotient(mean, ring.positions) > naive::smallest_quotient(here, ring.positions);
    const bool more_inverted = naive::inverted(mean, ring.positions) > naive::inverted(here, ring.positions);
    const auto move = SmartLaplacian::update<TestType>(here, ring);
    REQUIRE(move.moved == (better && !more_inverted));
    REQUIRE(move.position == (move.moved ? mean : here));
    moved += move.moved ? 1 : 0;
    held_by_quality += better ? 0 : 1;
    held_by_count += better && more_inverted ? 1 : 0;
  }
  CHECK(moved > 1000);
  CHECK(held_by_quality > 1000);
  CHECK(held_by_count > 10);
}

TEST_CASE("equal is not better: a vertex whose smallest quotient would stay the same stays") {
  // Mirrored: (x, 0) to (-x, 0), the mean being in the middle of nothing but the mirror image.
  const RingOf<double> ring{{{3, -2}, {3, 2}, {-3, 2}, {-3, -2}}};
  CHECK(SmartLaplacian::update<double>({1, 0}, ring).moved);
  CHECK_FALSE(SmartLaplacian::update<double>({0, 0}, ring).moved);
  // All on one line: every quotient is 0, there and at the mean.
  const RingOf<double> line{{{0, 0}, {1, 0}, {2, 0}, {5, 0}}};
  CHECK_FALSE(SmartLaplacian::update<double>({1, 0}, line).moved);
}

TEST_CASE("a move that betters the smallest quotient but inverts more triangles is not made") {
  // The vertex is far outside: its first triangle is inverted, the worst of all. From the mean that one is valid, but
  // the last two, at the notch in the ring, are slightly inverted.
  const RingOf<double> ring{{{4, -2}, {-1, 2}, {-3, -1}, {0, 0}}};
  const Point2<double> here{4, 3};
  const Point2<double> mean{0, -0.25};
  REQUIRE(naive::laplacian(ring.positions) == mean);
  REQUIRE(naive::smallest_quotient(here, ring.positions) < -0.27);
  REQUIRE(naive::smallest_quotient(mean, ring.positions) > -0.04);
  REQUIRE(naive::inverted(here, ring.positions) == 1);
  REQUIRE(naive::inverted(mean, ring.positions) == 2);
  CHECK_FALSE(SmartLaplacian::update<double>(here, ring).moved);
}

TEST_CASE("of a tangled ring a vertex moves as soon as its worst triangle is less inverted") {
  // From outside the square, three triangles inverted or not, into its middle.
  const RingOf<double> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const auto move = SmartLaplacian::update<double>({3, 0}, square);
  CHECK(move.moved);
  CHECK(move.position == Point2<double>{0, 0});
}

TEST_CASE("a quotient that is no number never passes for better") {
  // Products of the far corners' coordinates overflow, which no local frame lets happen. The other quotients do get
  // better on the way to the mean.
  const RingOf<double> ring{{{1e200, 1e200}, {1e200, 2e200}, {-1, 0}, {0, -1}}};
  const Point2<double> mean = naive::laplacian(ring.positions);
  const double far = naive::quotient(mean, ring[0], ring[1]);
  REQUIRE(far != far);
  CHECK_FALSE(is_better_than(-2.0, mean, ring));
  CHECK_FALSE(SmartLaplacian::update<double>({-0.4, -0.4}, ring).moved);
}

}  // namespace trismooth::smart_laplacian_test

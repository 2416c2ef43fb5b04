#include "trismooth/smoothing/methods/weighted_laplacian.h"

#include <cmath>
#include <limits>

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/random_rings.h"

using random_rings::RingOf;
using trismooth::Point2;
using trismooth::WeightedLaplacian;

TEMPLATE_TEST_CASE("a vertex moves to the mean weighted by inverse edge length, bit for bit", "", float, double) {
  test_meshes::Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const RingOf<TestType> ring = random_rings::any<TestType>(random);
    const Point2<TestType> here{static_cast<TestType>(random.between(-1, 1)),
                                static_cast<TestType>(random.between(-1, 1))};
    const auto move = WeightedLaplacian::update<TestType>(here, ring);
    REQUIRE(move.moved);
    REQUIRE(move.position == naive::weighted(here, ring.positions));
  }
}

TEST_CASE("near neighbours pull more than far ones") {
  // Weights 1 and 1/3: (1 * -1 + 1/3 * 3) / (4/3) = 0 against the plain mean 1.
  const RingOf<double> line{{{-1, 0}, {3, 0}}};
  CHECK(WeightedLaplacian::update<double>({0, 0}, line).moved == false);
  const RingOf<double> ring{{{-1, 0}, {0, -4}, {3, 0}, {0, 4}}};
  CHECK(std::abs(WeightedLaplacian::update<double>({0, 0}, ring).position.x) < 1e-15);
  CHECK(trismooth::laplacian_position<double>(ring).x == 0.5);
}

TEMPLATE_TEST_CASE("a vertex that lies on a neighbour stays there", "", float, double) {
  test_meshes::Random random(2);
  for (int i = 0; i < 500; ++i) {
    const RingOf<TestType> ring = random_rings::any<TestType>(random);
    const Point2<TestType> here = ring[random.below(ring.size())];
    const auto move = WeightedLaplacian::update<TestType>(here, ring);
    REQUIRE_FALSE(move.moved);
    REQUIRE(move.position == here);
  }
}

TEMPLATE_TEST_CASE("an edge so short that its square is 0 holds the vertex, too", "", float, double) {
  const TestType tiny = std::numeric_limits<TestType>::min();
  const RingOf<TestType> ring{{{tiny, 0}, {0, 1}, {-1, -1}}};
  CHECK_FALSE(WeightedLaplacian::update<TestType>({0, 0}, ring).moved);
}

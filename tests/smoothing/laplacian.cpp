// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/methods/laplacian.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/random_rings.h"

namespace trismooth::laplacian_test {

TEMPLATE_TEST_CASE("a vertex moves to the mean of its neighbours, whatever that does", "", float, double) {
  test_meshes::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto ring = random_rings::any<TestType>(random);
    const Point2<TestType> here{static_cast<TestType>(random.between(-1, 1)),
                                static_cast<TestType>(random.between(-1, 1))};
    const auto move = Laplacian::update<TestType>(here, ring);
    REQUIRE(move.moved);
    REQUIRE(move.position == naive::laplacian(ring.positions));
    REQUIRE_FALSE(Laplacian::update<TestType>(move.position, ring).moved);
  }
}

}  // namespace trismooth::laplacian_test

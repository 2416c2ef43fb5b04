// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/gathered_ring.h"

#include <cstdint>
#include <vector>

#include "catch.h"

namespace trismooth::gathered_ring_test {

TEMPLATE_TEST_CASE("a gathered ring holds the positions of its vertices in ring order, whatever its size", "", float,
                   double) {
  std::vector<Point2<TestType>> points;
  for (int i = 0; i < 50; ++i) {
    points.push_back({static_cast<TestType>(i), static_cast<TestType>(-2 * i)});
  }
  RingGatherer<TestType> gatherer;
  for (const std::int32_t size : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 40, 3, 12}) {
    CAPTURE(size);
    std::vector<std::int32_t> ring;
    for (std::int32_t i = 0; i < size; ++i) {
      ring.push_back((7 * i + size) % 50);
    }
    const trismooth::GatheredRing<TestType> gathered = gatherer.gather(points, ring);
    CHECK(gathered.size() == size);
    for (std::int32_t i = 0; i < size; ++i) {
      CHECK(gathered[i] == points[ring[i]]);
      CHECK(gathered.number(i) == ring[i]);
    }
  }
}

}  // namespace trismooth::gathered_ring_test

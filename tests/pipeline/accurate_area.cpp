// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/accurate_area.h"

#include <cmath>
#include <cstdint>

#include "catch.h"
#include "support/dice.h"
#include "support/test_meshes.h"

namespace trismooth::accurate_area_test {

__extension__ using Wide = __int128;

TEST_CASE("areas have the sign and the digits that whole numbers of 128 bits have") {
  // Points on a fine grid: coordinates are whole numbers of it, so that the area is one of its square.
  test_meshes::Random dice(7);
  constexpr double grid = 0x1p-50;
  for (int round = 0; round < 20000; ++round) {
    const auto coordinate = [&] { return static_cast<std::int64_t>(dice.between(0, 1) * 0x1p50); };
    const std::int64_t ax = coordinate();
    const std::int64_t ay = coordinate();
    const std::int64_t bx = coordinate();
    const std::int64_t by = coordinate();
    // On the line through the two, or next to it.
    const double along = dice.between(0, 1);
    const auto near = static_cast<std::int64_t>(dice.between(0, 1) * 5) - 2;
    const auto cx = ax + static_cast<std::int64_t>(along * static_cast<double>(bx - ax));
    const auto cy = ay + static_cast<std::int64_t>(along * static_cast<double>(by - ay)) + near;
    const Wide exact = static_cast<Wide>(bx - ax) * (cy - ay) - static_cast<Wide>(by - ay) * (cx - ax);
    const auto point = [](std::int64_t x, std::int64_t y) {
      return Point2<double>{static_cast<double>(x) * grid, static_cast<double>(y) * grid};
    };
    const double area = doubled_area(point(ax, ay), point(bx, by), point(cx, cy));
    const double expected = static_cast<double>(exact) * grid * grid;
    CHECK(std::abs(area - expected) <= 1e-12 * std::abs(expected));
  }
}

TEST_CASE("three points on a line have no area, wherever the line is") {
  CHECK(doubled_area({0.1, 0.1}, {0.2, 0.2}, {0.7, 0.7}) == 0);
  CHECK(doubled_area({3, 1e-300}, {3, 2}, {3, -1e-300}) == 0);
  CHECK(doubled_area({0, 0}, {1, 0}, {0, 1}) == 1);
  CHECK(doubled_area({0, 0}, {0, 1}, {1, 0}) == -1);
}

}  // namespace trismooth::accurate_area_test

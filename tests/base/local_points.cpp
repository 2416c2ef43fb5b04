// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/local_points.h"

#include <cstdint>
#include <vector>

#include "catch.h"

namespace trismooth::local_points_test {

TEST_CASE("the frame of cells is that of the vertices that a cell uses") {
  namespace hold = trismooth::hold;
  const std::vector<Point2<double>> points{{1e9, 0}, {100, 50}, {101, 52}, {99, 51}, {-1e9, 3}};
  // Of nobody; free; of a boundary; isolated, but of another cell; of nobody, and named.
  const std::vector<std::uint8_t> held{hold::isolated, 0, hold::boundary, hold::isolated | hold::other_cell,
                                       hold::isolated | hold::named};
  const LocalFrame found = trismooth::local_frame_of_cells(points, held);
  const LocalFrame expected = trismooth::local_frame({99, 50}, {101, 52});
  CHECK(found.centre_x == expected.centre_x);
  CHECK(found.centre_y == expected.centre_y);
  CHECK(found.exponent == expected.exponent);
}

TEST_CASE("points enter their frame one by one") {
  const std::vector<Point2<double>> points{{3, 7}, {5, -1}, {4, 2}};
  const LocalFrame frame = trismooth::local_frame(points);
  const trismooth::LocalPoints local = trismooth::entered(frame, points);
  CHECK(local.frame.exponent == frame.exponent);
  REQUIRE(local.points.size() == 3);
  for (std::size_t v = 0; v < 3; ++v) {
    CHECK(local.points[v] == frame.enter(points[v]));
  }
}

}  // namespace trismooth::local_points_test

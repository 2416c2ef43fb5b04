// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quadratic_quality.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "catch.h"

namespace trismooth::quadratic_quality_test {

TEST_CASE("quadratic triangles are counted, the invalid ones in the orientation of their component") {
  // A square of two triangles with middles, the second listed clockwise.
  const std::vector<Point2<double>> points{{0, 0},   {1, 0},     {1, 1},   {0, 1},  {0.5, 0},
                                           {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 0.5}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 3, 2}};
  const std::vector<QuadraticElement> elements{{0, {4, 5, 6, no_corner, no_corner}},
                                               {1, {8, 7, 6, no_corner, no_corner}}};
  const std::vector<std::uint8_t> reversed{0, 1};
  const auto good = quadratic_quality({points, triangles, reversed, 0}, elements, 1);
  CHECK(good.elements == 2);
  CHECK(good.invalid == 0);
  CHECK(good.min_jacobian == 1);
  const auto unturned = quadratic_quality({points, triangles, {}, 0}, elements, 1);
  CHECK(unturned.invalid == 1);
  CHECK(unturned.min_jacobian == -1);
  std::vector<Point2<double>> bent = points;
  bent[7] = {0.95, 1};
  CHECK(quadratic_quality({bent, triangles, reversed, 0}, elements, 2).invalid == 1);
  const auto none = quadratic_quality({points, triangles, reversed, 0}, {}, 1);
  CHECK(none.elements == 0);
  CHECK(std::isinf(none.min_jacobian));
}

}  // namespace trismooth::quadratic_quality_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/triangle_view.h"

#include <vector>

#include "catch.h"

namespace trismooth::triangle_view_test {

TEST_CASE("rotations of a triangle have the same canonical corners, the smallest first") {
  for (const Triangle triangle : {Triangle{1, 5, 9}, Triangle{5, 9, 1}, Triangle{9, 1, 5}}) {
    CHECK(canonical_corners(triangle, false) == Triangle{1, 5, 9});
    CHECK(canonical_corners(triangle, true) == Triangle{1, 9, 5});
  }
  for (const Triangle triangle : {Triangle{1, 9, 5}, Triangle{9, 5, 1}, Triangle{5, 1, 9}}) {
    CHECK(canonical_corners(triangle, false) == Triangle{1, 9, 5});
    CHECK(canonical_corners(triangle, true) == Triangle{1, 5, 9});
  }
}

TEST_CASE("a view without reversal flags has no reversed triangle") {
  const std::vector<Triangle> triangles{{2, 1, 0}, {4, 3, 5}};
  const std::vector<std::uint8_t> reversed{1, 0};
  CHECK(canonical_corners(TriangleView{{}, triangles, {}, 0}, 0) == Triangle{0, 2, 1});
  CHECK(canonical_corners(TriangleView{{}, triangles, reversed, 0}, 0) == Triangle{0, 1, 2});
  CHECK(canonical_corners(TriangleView{{}, triangles, reversed, 0}, 1) == Triangle{3, 5, 4});
}

}  // namespace trismooth::triangle_view_test

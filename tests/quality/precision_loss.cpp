// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/precision_loss.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/base/local_frame.h"

#include "catch.h"

namespace trismooth::precision_loss_test {

using Point = trismooth::Point2<double>;

/// A large triangle and small right-angled ones of size `small` near the point (1/3, 1/5), whose coordinates have all
/// digits.
PrecisionLoss loss_beside(double small, std::int32_t count, int threads = 1) {
  std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}};
  std::vector<Triangle> triangles{{0, 1, 2}};
  for (std::int32_t i = 0; i < count; ++i) {
    const Point corner{1.0 / 3 + 1e-3 * i / count, 0.2};
    points.insert(points.end(), {corner, {corner.x + small, corner.y}, {corner.x, corner.y + small}});
    triangles.push_back({3 * i + 3, 3 * i + 4, 3 * i + 5});
  }
  return trismooth::single_precision_loss({points, triangles, {}}, threads);
}

TEST_CASE("a mesh of one size is held by single precision") {
  const PrecisionLoss loss = loss_beside(0.01, 100);
  CHECK(loss.elements == 101);
  CHECK(loss.collapsed == 0);
  CHECK(loss.distorted == 0);
  CHECK_FALSE(loss.any());
}

TEST_CASE("triangles far below the spacing of float32 collapse, those of some spacings are distorted") {
  const PrecisionLoss tiny = loss_beside(1e-10, 100);
  CHECK(tiny.collapsed == 100);
  CHECK(tiny.distorted == 0);
  const PrecisionLoss coarse = loss_beside(7e-8, 100);
  CHECK(coarse.collapsed == 0);
  CHECK(coarse.distorted > 20);
  CHECK(coarse.any());
}

TEST_CASE("triangles that are degenerate or inverted in double are not said to collapse") {
  const std::vector<Point> points{{0, 0}, {1, 0}, {0.25, 0}, {0, 1}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 3, 1}};
  CHECK_FALSE(trismooth::single_precision_loss({points, triangles, {}}).any());
}

TEST_CASE("the counts do not depend on the number of threads") {
  for (const int threads : {2, 5}) {
    const PrecisionLoss loss = loss_beside(4e-8, 20000, threads);
    const PrecisionLoss alone = loss_beside(4e-8, 20000);
    CHECK(loss.collapsed == alone.collapsed);
    CHECK(loss.distorted == alone.distorted);
  }
}

TEST_CASE("a triangle whose squares vanish in float32 has collapsed") {
  const std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}, {0, 1e-30}, {1e-30, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 4, 3}};
  CHECK(trismooth::single_precision_loss({points, triangles, {}}).collapsed == 1);
}

TEST_CASE("the description says how many of what") {
  const std::string begin = "single precision cannot hold this mesh; rounded to it, ";
  const std::string collapsed = "elements that collapse: 4 of 18";
  const std::string distorted = "elements whose shape changes by more than 0.01: 1 of 18";
  CHECK(describe(PrecisionLoss{18, 4, 0}) == begin + collapsed);
  CHECK(describe(PrecisionLoss{18, 0, 1}) == begin + distorted);
  CHECK(describe(PrecisionLoss{18, 4, 1}) == begin + collapsed + ", " + distorted);
}

}  // namespace trismooth::precision_loss_test

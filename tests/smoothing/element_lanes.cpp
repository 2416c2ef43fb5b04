// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/guard/element_lanes.h"

#include <cmath>
#include <limits>
#include <vector>

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::element_lanes_test {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// What the guard has to know of an element, from its definition in words.
double expected_worsened(double before, double after) {
  if (std::isnan(after) || std::isinf(after)) {
    return -infinite;
  }
  if (before > 0 && after <= 0) {
    return -infinite;
  }
  return after < before ? after : infinite;
}

Point2<double> random_point(test_meshes::Random& random) {
  // Few different coordinates: so corners coincide, and triangles are degenerate in every way.
  const bool on_grid = random.below(2) == 0;
  const double x = on_grid ? random.below(3) - 1 : random.between(-1, 1);
  const double y = on_grid ? random.below(3) - 1 : random.between(-1, 1);
  return {x, y};
}

TEST_CASE("elements side by side are measured as one by one, to the bit, by all instructions and in any number") {
  test_meshes::Random random(11);
  const std::vector<trismooth::Triangle> one{{0, 1, 2}};
  int unmoved = 0;
  int worse = 0;
  int lost = 0;
  for (const InstructionSet instructions : {InstructionSet::baseline, InstructionSet::avx2}) {
    if (instructions > trismooth::instruction_set()) {
      continue;
    }
    const auto measure = trismooth::element_measure<trismooth::Triangle>(instructions);
    for (int count = 1; count <= ElementLanes<trismooth::Triangle>::lanes; ++count) {
      ElementLanes<trismooth::Triangle> elements;
      for (int lane = 0; lane < ElementLanes<trismooth::Triangle>::lanes; ++lane) {
        const double scale = std::ldexp(1, random.below(4) == 0 ? -random.below(500) : 0);
        const int moving = random.below(4);  // 3: none
        for (int corner = 0; corner < 3; ++corner) {
          const Point2<double> from = random_point(random);
          const Point2<double> to = corner == moving ? random_point(random) : from;
          elements.before_x[corner][lane] = scale * from.x;
          elements.before_y[corner][lane] = scale * from.y;
          elements.after_x[corner][lane] = scale * to.x;
          elements.after_y[corner][lane] =
              random.below(50) == 0 ? std::numeric_limits<double>::quiet_NaN() : scale * to.y;
        }
      }
      measure(count, elements);
      for (int lane = 0; lane < count; ++lane) {
        CAPTURE(instructions, count, lane);
        std::vector<Point2<double>> before;
        std::vector<Point2<double>> after;
        for (int corner = 0; corner < 3; ++corner) {
          before.push_back({elements.before_x[corner][lane], elements.before_y[corner][lane]});
          after.push_back({elements.after_x[corner][lane], elements.after_y[corner][lane]});
        }
        const double was = naive::element_quotient(before, one.front());
        const double is = naive::element_quotient(after, one.front());
        const bool moved = !(before == after);
        REQUIRE(same_bits(elements.quotients[lane], moved ? was : infinite));
        REQUIRE(same_bits(elements.worsened[lane], moved ? expected_worsened(was, is) : infinite));
        unmoved += moved ? 0 : 1;
        worse += std::isfinite(elements.worsened[lane]) ? 1 : 0;
        lost += elements.worsened[lane] == -infinite ? 1 : 0;
      }
    }
  }
  CHECK(unmoved > 100);
  CHECK(worse > 100);
  CHECK(lost > 100);
}

}  // namespace trismooth::element_lanes_test

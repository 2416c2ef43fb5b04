// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/angle.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::angle_test {

/// How far from the true angle, in units in the last place of it.
double error_in_units(double y, double x) {
  const long double true_angle = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  const auto rounded = static_cast<double>(true_angle);
  const double unit = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return static_cast<double>(std::abs((static_cast<long double>(angle_above_axis(y, x)) - true_angle) / unit));
}

TEST_CASE("angles are those of long double within three units in the last place") {
  test_meshes::Random random(3);
  double worst = 0;
  for (int i = 0; i < 2000000; ++i) {
    const double angle = std::numbers::pi * random.between(0, 1);
    const double radius = std::ldexp(1, random.below(60) - 30);
    const double y = std::abs(radius * std::sin(angle)) * (i % 3 == 0 ? std::ldexp(1, -random.below(80)) : 1);
    if (y > 0) {
      worst = std::max(worst, error_in_units(y, radius * std::cos(angle)));
    }
  }
  CHECK(worst <= 3);
}

TEST_CASE("angles where the formula changes are exact, or as near as the others") {
  constexpr double pi = std::numbers::pi;
  CHECK(angle_above_axis(1, 1) == pi / 4);
  CHECK(angle_above_axis(3, 0) == pi / 2);
  CHECK(angle_above_axis(0.25, -0.25) == pi - pi / 4);
  CHECK(angle_above_axis(1, std::numeric_limits<double>::max()) == 1 / std::numeric_limits<double>::max());
  CHECK(angle_above_axis(std::numeric_limits<double>::denorm_min(), -1) == pi);
  for (const double tangent : {std::numbers::sqrt2 - 1, 1.0, std::numbers::sqrt2 + 1}) {
    for (const double beside : {std::nextafter(tangent, 0), tangent, std::nextafter(tangent, 3)}) {
      CAPTURE(tangent, beside);
      CHECK(error_in_units(beside, 1) <= 3);
      CHECK(error_in_units(beside, -1) <= 3);
    }
  }
}

}  // namespace trismooth::angle_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/space/mercator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catch.h"

using trismooth::latitude_of_mercator;
using trismooth::mercator_of_latitude;

namespace mercator_test {

constexpr long double radians = std::numbers::pi_v<long double> / 180;

/// How many units in the last place of the double `expected` the number is off.
double units_off(double value, long double expected) {
  const double rounded = std::abs(static_cast<double>(expected));
  const double unit = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return static_cast<double>(std::abs(value - expected) / unit);
}

TEST_CASE("coordinates of latitudes are those of the C library in long double, to a few units in the last place") {
  double worst = 0;
  double worst_back = 0;
  for (int i = -89999; i <= 89999; ++i) {
    const double latitude = i * 1e-3;
    const double coordinate = mercator_of_latitude(latitude);
    worst = std::max(worst, units_off(coordinate, std::asinh(std::tan(latitude * radians)) / radians));
    worst_back = std::max(
        worst_back, units_off(latitude_of_mercator(coordinate), std::atan(std::sinh(coordinate * radians)) / radians));
  }
  CHECK(worst <= 6);
  CHECK(worst_back <= 6);
  for (double small = 1; small > 1e-300; small /= 3) {
    CHECK(units_off(mercator_of_latitude(small), std::asinh(std::tan(small * radians)) / radians) <= 6);
    CHECK(units_off(latitude_of_mercator(small), std::atan(std::sinh(small * radians)) / radians) <= 6);
    const long double colatitude = (90 - static_cast<long double>(90 - small)) * radians;
    if (small < 45 && 90 - small < 90) {
      CHECK(units_off(mercator_of_latitude(90 - small), -std::log(std::tan(colatitude / 2)) / radians) <= 6);
    }
  }
}

TEST_CASE("there and back is the same latitude, north and south alike") {
  for (int i = -8999; i <= 8999; ++i) {
    const double latitude = i * 1e-2;
    const double back = latitude_of_mercator(mercator_of_latitude(latitude));
    CHECK(std::abs(back - latitude) <= 4e-14);
    CHECK(mercator_of_latitude(-latitude) == -mercator_of_latitude(latitude));
    CHECK(latitude_of_mercator(-i) == -latitude_of_mercator(i));
  }
  CHECK(mercator_of_latitude(0) == 0);
  CHECK(latitude_of_mercator(1e9) == 90);
}

TEST_CASE("the scale is one by the cosine") {
  for (double latitude = -85; latitude < 86; latitude += 5) {
    constexpr double step = 1e-5;
    const double slope = (mercator_of_latitude(latitude + step) - mercator_of_latitude(latitude - step)) / (2 * step);
    CHECK(slope == Approx(1 / std::cos(latitude * static_cast<double>(radians))).epsilon(1e-8));
  }
}

}  // namespace mercator_test

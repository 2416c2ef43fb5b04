// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/triangle_quality.h"

#include <cmath>
#include <limits>
#include <random>

#include "catch.h"

namespace trismooth::triangle_quality_test {

using Point = Point2<double>;

TEST_CASE("an equilateral triangle has shape 1, whatever its place and size") {
  const double height = std::sqrt(3.0) / 2;
  CHECK(shape(Point{0, 0}, Point{1, 0}, Point{0.5, height}) == Approx(1).epsilon(1e-15));
  CHECK(shape(Point{10, -20}, Point{14, -20}, Point{12, -20 + 4 * height}) == Approx(1).epsilon(1e-14));
  CHECK(shape(Point2<float>{0, 0}, Point2<float>{1, 0}, Point2<float>{0.5F, static_cast<float>(height)}) ==
        Approx(1).epsilon(1e-6));
}

TEST_CASE("shape of right triangles worked out by hand") {
  // 2 sqrt(3) * 1 / (1 + 1 + 2) and 2 sqrt(3) * 12 / (9 + 16 + 25)
  CHECK(shape(Point{0, 0}, Point{1, 0}, Point{0, 1}) == Approx(std::sqrt(3.0) / 2).epsilon(1e-15));
  CHECK(shape(Point{0, 0}, Point{3, 0}, Point{0, 4}) == Approx(std::sqrt(3.0) * 24 / 50).epsilon(1e-15));
}

TEST_CASE("a degenerate triangle has shape 0") {
  CHECK(shape(Point{0, 0}, Point{1, 1}, Point{2, 2}) == 0);
  CHECK(shape(Point{0, 0}, Point{0, 0}, Point{1, 2}) == 0);
  CHECK(shape(Point{3, 4}, Point{3, 4}, Point{3, 4}) == 0);
  const double tiny = std::numeric_limits<double>::denorm_min();
  CHECK(shape(Point{0, 0}, Point{tiny, 0}, Point{0, tiny}) == 0);
}

TEST_CASE("reversal changes the sign of shape and at most its last digits") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 10000; ++i) {
    const Point a{coordinate(random), coordinate(random)};
    const Point b{coordinate(random), coordinate(random)};
    const Point c{coordinate(random), coordinate(random)};
    REQUIRE(shape(a, c, b) == Approx(-shape(a, b, c)).epsilon(1e-15));
  }
}

TEST_CASE("shape stays within -1 and 1 up to rounding, and has the sign of the orientation") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 10000; ++i) {
    const Point a{coordinate(random), coordinate(random)};
    const Point b{coordinate(random), coordinate(random)};
    const Point c{coordinate(random), coordinate(random)};
    const double value = shape(a, b, c);
    REQUIRE(std::abs(value) <= 1 + 1e-15);
    const auto cross_product = static_cast<long double>(b.x - a.x) * static_cast<long double>(c.y - a.y) -
                               static_cast<long double>(b.y - a.y) * static_cast<long double>(c.x - a.x);
    if (std::abs(value) > 1e-12) {
      REQUIRE((value > 0) == (cross_product > 0));
    }
  }
}

TEST_CASE("a power of two and a quarter turn change no bit of shape") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 10000; ++i) {
    const Point a{coordinate(random), coordinate(random)};
    const Point b{coordinate(random), coordinate(random)};
    const Point c{coordinate(random), coordinate(random)};
    const double expected = shape(a, b, c);
    for (const int power : {-300, -1, 1, 300}) {
      const auto scaled = [power](Point p) { return Point{std::ldexp(p.x, power), std::ldexp(p.y, power)}; };
      REQUIRE(shape(scaled(a), scaled(b), scaled(c)) == expected);
    }
    const auto turned = [](Point p) { return Point{-p.y, p.x}; };
    REQUIRE(shape(turned(a), turned(b), turned(c)) == expected);
  }
}

TEST_CASE("the quotient from edges is the quotient from points") {
  const Point a{0.1, 0.2};
  const Point b{1.3, -0.4};
  const Point c{0.7, 0.9};
  CHECK(shape_quotient(b - a, c - a, squared_length(b - a), squared_length(c - b), squared_length(c - a)) ==
        shape_quotient(a, b, c));
}

}  // namespace trismooth::triangle_quality_test

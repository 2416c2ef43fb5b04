// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/local_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "catch.h"
#include "support/same_bits.h"

namespace trismooth::local_frame_test {

using Point = Point2<double>;
using Points = std::vector<Point>;

/// Points of a box of the extents around the centre, the box's corners among them.
Points random_points(Point centre, Point extent, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  Points points;
  for (const double corner : {-0.5, 0.5}) {
    points.push_back({centre.x + corner * extent.x, centre.y + corner * extent.y});
  }
  for (int i = 0; i < 1000; ++i) {
    const double x = part(random);
    points.push_back({centre.x + x * extent.x, centre.y + part(random) * extent.y});
  }
  return points;
}

/// One axis of the frame by the C library's means.
struct ReferenceAxis {
  double centre;
  int exponent;
};

ReferenceAxis reference_axis(double low, double high) {
  const int unit = std::ilogb(std::max(std::abs(low), std::abs(high)));
  const double low_in_units = std::ldexp(low, -unit);
  const double high_in_units = std::ldexp(high, -unit);
  const double extent = high_in_units - low_in_units;
  const double middle = (low_in_units + high_in_units) / 2;
  const int exponent = std::ilogb(extent) + unit + 1;
  if (std::abs(middle) < 1.5 * extent) {
    return {0, exponent};
  }
  const int grid = std::ilogb(extent) - 3;
  return {std::ldexp(std::round(std::ldexp(middle, -grid)), grid + unit), exponent};
}

/// The frame of a box that has an extent along both axes.
void require_reference_frame(Point low, Point high) {
  CAPTURE(low.x, low.y, high.x, high.y);
  const ReferenceAxis x = reference_axis(low.x, high.x);
  const ReferenceAxis y = reference_axis(low.y, high.y);
  const LocalFrame frame = local_frame(low, high);
  REQUIRE(same_bits(frame.centre_x, x.centre));
  REQUIRE(same_bits(frame.centre_y, y.centre));
  REQUIRE(frame.exponent == std::max(x.exponent, y.exponent));
}

Points entered(const Points& stored) {
  const LocalFrame frame = local_frame(stored);
  Points local;
  for (const Point point : stored) {
    local.push_back(frame.enter(point));
  }
  return local;
}

/// Every point is within the local frame's range and comes back with all its bits.
void require_lossless(const Points& stored) {
  const LocalFrame frame = local_frame(stored);
  CAPTURE(frame.centre_x, frame.centre_y, frame.exponent);
  double low_x = 2;
  double high_x = -2;
  double low_y = 2;
  double high_y = -2;
  for (const Point point : stored) {
    const Point local = frame.enter(point);
    REQUIRE(same_bits(frame.leave(local), point));
    low_x = std::min(low_x, local.x);
    high_x = std::max(high_x, local.x);
    low_y = std::min(low_y, local.y);
    high_y = std::max(high_y, local.y);
  }
  CHECK(low_x >= -2);
  CHECK(low_y >= -2);
  CHECK(high_x <= 2);
  CHECK(high_y <= 2);
  const double extent = std::max(high_x - low_x, high_y - low_y);
  CHECK(extent >= 0.5);
  CHECK(extent <= 1);
}

TEST_CASE("stored coordinates survive the way into the local frame and back") {
  SECTION("unit square") {
    require_lossless(random_points({0.5, 0.5}, {1, 1}));
  }
  SECTION("around the origin, flat") {
    require_lossless(random_points({0, 0}, {1000, 1e-3}));
  }
  SECTION("map coordinates") {
    require_lossless(random_points({4e7, 5.5e6}, {1234, 567}));
  }
  SECTION("map coordinates, negative") {
    require_lossless(random_points({-4e7, -5.5e6}, {1234, 567}));
  }
  SECTION("one axis far away") {
    require_lossless(random_points({4e7, 0.1}, {1, 1}));
  }
  SECTION("just near enough not to be translated") {
    require_lossless(random_points({1.49, -1.49}, {1, 1}));
  }
  SECTION("just far enough to be translated") {
    require_lossless(random_points({1.51, -1.51}, {1, 1}));
  }
  SECTION("nearly all digits in the offset") {
    require_lossless(random_points({1e16, -1e16}, {64, 32}));
  }
  SECTION("large") {
    require_lossless(random_points({0, 1e200}, {1e200, 1e199}));
  }
  SECTION("small") {
    require_lossless(random_points({1e-300, 0}, {1e-301, 1e-301}));
  }
  SECTION("half the range") {
    const double most = std::numeric_limits<double>::max();
    require_lossless({{0, 0}, {most, 0}, {0, most}, {most / 3, most / 7}});
  }
  SECTION("the whole range") {
    const double most = std::numeric_limits<double>::max();
    require_lossless({{-most, -most}, {most, most}, {most / 3, -most / 7}, {-1e300, 1e308}});
  }
  SECTION("far away in the last binade") {
    const double most = std::numeric_limits<double>::max();
    require_lossless({{most, -most}, {most * 0.9, -most * 0.9}, {most * 0.95, -most * 0.97}});
  }
  SECTION("subnormal") {
    const double tiny = std::numeric_limits<double>::denorm_min();
    require_lossless({{0, 0}, {1000 * tiny, 0}, {7 * tiny, 999 * tiny}});
    require_lossless({{0, 0}, {tiny, 0}, {0, tiny}});
    require_lossless({{100000 * tiny, -90000 * tiny}, {100001 * tiny, -90001 * tiny}, {100003 * tiny, -90000 * tiny}});
  }
}

TEST_CASE("signs of zeros survive where there is no translation") {
  const LocalFrame frame = local_frame(Points{{-0.0, 0.0}, {3, 3}});
  CHECK(same_bits(frame.leave(frame.enter({-0.0, 0.0})), Point{-0.0, 0.0}));
}

TEST_CASE("entering rounds nothing") {
  // 64 digits hold the difference of the coordinates; nothing here depends on the frame's own arithmetic.
  STATIC_REQUIRE(std::numeric_limits<long double>::digits >= 64);
  for (const Point centre : {Point{4e7, -3e9}, Point{0.3, 17}, Point{-1e5, 2}}) {
    const Points stored = random_points(centre, {1.7, 0.3});
    const LocalFrame frame = local_frame(stored);
    for (const Point point : stored) {
      const Point local = frame.enter(point);
      REQUIRE(std::ldexp(static_cast<long double>(local.x), frame.exponent) ==
              static_cast<long double>(point.x) - static_cast<long double>(frame.centre_x));
      REQUIRE(std::ldexp(static_cast<long double>(local.y), frame.exponent) ==
              static_cast<long double>(point.y) - static_cast<long double>(frame.centre_y));
    }
  }
}

TEST_CASE("an axis is translated only where its centre is far away") {
  const LocalFrame frame = local_frame(random_points({100, 0.5}, {1, 1}));
  CHECK(frame.centre_x == Approx(100).margin(0.1));
  CHECK(frame.centre_y == 0);
  CHECK(local_frame(random_points({1.49, 1.51}, {1, 1})).centre_x == 0);
  CHECK(local_frame(random_points({1.49, 1.51}, {1, 1})).centre_y == Approx(1.51).margin(0.1));
}

TEST_CASE("a mesh scaled by a power of two enters to the same bits") {
  for (const Point centre : {Point{0, 0}, Point{0.5, 0.5}, Point{4e7, -3e5}, Point{1.6, -1.4}, Point{1e15, 0}}) {
    const Points stored = random_points(centre, {1, 0.7});
    const Points expected = entered(stored);
    for (const int power : {-900, -31, -1, 1, 2, 30, 900}) {
      Points scaled;
      for (const Point point : stored) {
        scaled.push_back({std::ldexp(point.x, power), std::ldexp(point.y, power)});
      }
      CAPTURE(centre.x, centre.y, power);
      CHECK(local_frame(scaled).exponent == local_frame(stored).exponent + power);
      const Points actual = entered(scaled);
      for (std::size_t i = 0; i < stored.size(); ++i) {
        REQUIRE(same_bits(actual[i], expected[i]));
      }
    }
  }
}

TEST_CASE("the same holds down into the subnormal range and up to the largest numbers") {
  // Integers of 20 digits have exact multiples over the whole range of exponents.
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> near_by(0, 1000);
  Points stored;
  for (int i = 0; i < 1000; ++i) {
    const double x = 500000 + near_by(random);
    stored.push_back({x, static_cast<double>(near_by(random))});
  }
  const Points expected = entered(stored);
  for (const int power : {-1074, -1073, -1050, -1022, -500, 500, 1004}) {
    Points scaled;
    for (const Point point : stored) {
      scaled.push_back({std::ldexp(point.x, power), std::ldexp(point.y, power)});
    }
    CAPTURE(power);
    const Points actual = entered(scaled);
    for (std::size_t i = 0; i < stored.size(); ++i) {
      REQUIRE(same_bits(actual[i], expected[i]));
    }
    require_lossless(scaled);
  }
}

TEST_CASE("meshes without extent along an axis") {
  SECTION("no points: the identity") {
    const LocalFrame frame = local_frame({});
    CHECK(same_bits(frame.enter({3, 4}), Point{3, 4}));
    CHECK(frame.length_scale() == 1);
  }
  SECTION("one point is the origin of its frame") {
    const LocalFrame frame = local_frame(Points{{3, -1e300}});
    CHECK(frame.enter({3, -1e300}) == Point{0, 0});
    CHECK(frame.leave({0, 0}) == Point{3, -1e300});
    CHECK(frame.exponent == 0);
  }
  SECTION("a line is translated to an axis") {
    const LocalFrame frame = local_frame(Points{{0, 5}, {10, 5}});
    CHECK(frame.enter({10, 5}) == Point{0.625, 0});
    CHECK(frame.leave({0.625, 0}) == Point{10, 5});
  }
}

TEST_CASE("exponents and scales have the C library's bits for boxes of every size and place") {
  std::mt19937_64 random(11);
  // Any bits but those of infinities and what is no number: every exponent, subnormals among them.
  const auto any_number = [&random] {
    double number = 0;
    do {
      number = std::bit_cast<double>(random());
    } while (!std::isfinite(number));
    return number;
  };
  const auto subnormal = [&random] { return std::bit_cast<double>(random() >> (12 + random() % 52)); };
  const auto check = [](Point a, Point b) {
    if (a.x != b.x && a.y != b.y) {
      require_reference_frame({std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)});
    }
  };
  for (int i = 0; i < 20000; ++i) {
    check({any_number(), any_number()}, {any_number(), any_number()});
    check({subnormal(), -subnormal()}, {subnormal(), subnormal()});
    check({any_number(), 0}, {0, subnormal()});
    // Close together: from the next number on, to far enough apart not to be translated.
    const Point low{any_number(), std::abs(subnormal()) + std::numeric_limits<double>::min()};
    const auto further = [&random](double from) {
      return std::bit_cast<double>(std::bit_cast<std::uint64_t>(from) + (random() >> (8 + random() % 56)));
    };
    const Point high{further(low.x), further(low.y)};
    if (std::isfinite(high.x)) {
      check(low, high);
    }
  }
  const double most = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  for (const double a : {-most, -1.0, -least, 0.0, least, 1.0, most}) {
    for (const double b : {-most, -1.0, -least, 0.0, least, 1.0, most}) {
      check({a, a}, {b, b});
      check({a, b}, {std::nextafter(a, b), std::nextafter(b, a)});
    }
  }
}

TEST_CASE("an axis on which zeros of both signs lie has one frame, whichever comes first") {
  CHECK(same_bits(local_frame(Points{{0.0, 1}, {-0.0, 2}}).centre_x, 0.0));
  CHECK(same_bits(local_frame(Points{{-0.0, 1}, {0.0, 2}}).centre_x, 0.0));
}

TEST_CASE("the length scale is the power of two of the frame") {
  CHECK(local_frame(Points{{0, 0}, {10, 3}}).length_scale() == 16);
  CHECK(local_frame(Points{{0, 0}, {0.75, 0.1}}).length_scale() == 1);
  CHECK(local_frame(Points{{0, 0}, {0.25, 0.1}}).length_scale() == 0.5);
}

TEST_CASE("points that do not count have no say in the frame, and enter it at its edge") {
  const double most = std::numeric_limits<double>::max();
  const Points used = random_points({1e-3, 4e7}, {1e-6, 1});
  Points all{{most, -most}, {0, 0}};
  all.insert(all.end(), used.begin(), used.end());
  all.push_back({-1e200, 3e162});
  const auto is_used = [&](std::size_t i) { return i >= 2 && i < used.size() + 2; };
  const LocalFrame frame = local_frame(all, is_used);
  const LocalFrame expected = local_frame(used);
  CHECK(same_bits(frame.centre_x, expected.centre_x));
  CHECK(same_bits(frame.centre_y, expected.centre_y));
  CHECK(frame.exponent == expected.exponent);
  CHECK(frame.enter(all.front()) == Point{4, -4});
  CHECK(frame.enter(all.back()) == Point{-4, 4});

  const LocalFrame of_nothing = local_frame(all, [](std::size_t) { return false; });
  CHECK(of_nothing.exponent == 0);
  CHECK(of_nothing.centre_x == 0);
}

}  // namespace trismooth::local_frame_test

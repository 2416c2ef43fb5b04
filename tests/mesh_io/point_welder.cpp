// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/stl/point_welder.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "catch.h"
#include "support/hostile_meshes.h"

using trismooth::PointWelder;

namespace {

using Point = std::array<double, 3>;

/// Numbers in the order of first appearance, by comparing every point with all before it.
std::vector<std::int32_t> naive_numbers(const std::vector<Point>& points) {
  std::vector<Point> distinct;
  std::vector<std::int32_t> numbers;
  for (const Point& point : points) {
    const auto found = std::ranges::find(distinct, point);
    numbers.push_back(static_cast<std::int32_t>(found - distinct.begin()));
    if (found == distinct.end()) {
      distinct.push_back(point);
    }
  }
  return numbers;
}

std::vector<std::int32_t> welded(PointWelder& welder, const std::vector<Point>& points) {
  std::vector<std::int32_t> numbers;
  numbers.reserve(points.size());
  for (const Point& point : points) {
    numbers.push_back(welder.weld(point));
  }
  return numbers;
}

}  // namespace

TEST_CASE("points are numbered in the order of their first appearance, be they chosen for one slot or not") {
  const std::vector<Point> one_slot = hostile_meshes::points_of_one_slot(600);
  test_meshes::Random random(1);
  for (const bool hostile : {false, true}) {
    CAPTURE(hostile);
    // Each place three times or so, in any order; both zeros are one.
    std::vector<Point> points{{0, 0, 0}, {-0.0, 0, -0.0}, {0, -0.0, 1}, {0, 0, 1}};
    for (int i = 0; i < 2000; ++i) {
      const auto place = static_cast<std::size_t>(random.below(600));
      points.push_back(hostile ? one_slot[place] : Point{static_cast<double>(place), 1.0 / 3, -1e300});
    }
    PointWelder welder;
    const std::vector<std::int32_t> expected = naive_numbers(points);
    CHECK(welded(welder, points) == expected);
    CHECK(welded(welder, points) == expected);
    const std::size_t distinct = static_cast<std::size_t>(*std::ranges::max_element(expected)) + 1;
    CHECK(welder.size() == distinct);
    const std::vector<double> places = welder.take_points();
    REQUIRE(places.size() == 3 * distinct);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto number = static_cast<std::size_t>(expected[i]);
      REQUIRE(places[3 * number + 2] == points[i][2]);
    }
  }
}

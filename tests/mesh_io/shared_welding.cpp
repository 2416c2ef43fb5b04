// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/stl/shared_welding.h"

#include <array>
#include <cstring>
#include <vector>

#include "catch.h"
#include "support/dice.h"
#include "support/hostile_meshes.h"

using test_support::Dice;
using trismooth::FileWorkers;
using trismooth::PointWelder;
using trismooth::WeldedCorners;
using trismooth::Workers;

namespace {

template <class T>
void check_as_one_welder(const std::vector<std::array<T, 3>>& corners) {
  PointWelder welder;
  std::vector<std::int32_t> expected;
  for (const auto& corner : corners) {
    expected.push_back(welder.weld({corner[0], corner[1], corner[2]}));
  }
  const std::vector<double> points = welder.take_points();
  Workers alone(1);
  Workers two(2);
  for (Workers* const workers : {&alone, &two}) {
    for (const std::size_t part_bytes : {1UL, 50UL, 1000UL, 10000UL, FileWorkers::whole}) {
      const auto point_of = [&corners](std::size_t corner) { return corners[corner]; };
      const WeldedCorners got = trismooth::weld_corners<T>(corners.size(), point_of, FileWorkers(*workers, part_bytes));
      REQUIRE(got.vertices == expected);
      REQUIRE(got.points.size() == points.size());
      // 0 and -0 are one point, which is as it first appeared.
      REQUIRE((points.empty() || std::memcmp(got.points.data(), points.data(), points.size() * sizeof(double)) == 0));
    }
  }
}

template <class T>
std::vector<std::array<T, 3>> random_corners(Dice& dice, std::size_t count, std::size_t values) {
  const auto coordinate = [&] {
    const T value = static_cast<T>(dice.below(values)) / 8;
    return dice.below(2) == 0 ? -value : value;
  };
  std::vector<std::array<T, 3>> corners(count);
  for (auto& corner : corners) {
    corner = {coordinate(), coordinate(), coordinate()};
  }
  return corners;
}

}  // namespace

TEST_CASE("corners are welded in shares as one welder does it, by any number of threads") {
  Dice dice;
  for (const std::size_t values : {1UL, 2UL, 5UL, 1000UL}) {
    for (const std::size_t count : {0UL, 1UL, 2UL, 30UL, 3000UL}) {
      check_as_one_welder(random_corners<float>(dice, count, values));
      check_as_one_welder(random_corners<double>(dice, count, values));
    }
    check_as_one_welder(random_corners<float>(dice, 100'000, values));
  }
}

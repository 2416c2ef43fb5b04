// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/random_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "catch.h"

namespace trismooth::random_points_test {

TEST_CASE("a bounded random number meets every value about equally often") {
  std::mt19937_64 generator(1);
  for (const std::uint64_t bound : {1, 2, 3, 5, 8, 13}) {
    CAPTURE(bound);
    std::vector<int> met(bound, 0);
    constexpr int draws = 100000;
    for (int i = 0; i < draws; ++i) {
      const std::uint64_t value = random_below(bound, generator);
      REQUIRE(value < bound);
      ++met[value];
    }
    const double expected = draws / static_cast<double>(bound);
    for (const int times : met) {
      CHECK(times == Approx(expected).margin(6 * std::sqrt(expected)));
    }
  }
}

TEST_CASE("a random permutation holds every number once, and every order is about equally frequent") {
  std::mt19937_64 generator(2);
  std::vector<std::int32_t> large = random_permutation(1000, generator);
  CHECK_FALSE(std::is_sorted(large.begin(), large.end()));
  std::sort(large.begin(), large.end());
  for (std::int32_t i = 0; i < 1000; ++i) {
    REQUIRE(large[i] == i);
  }
  std::vector<int> met(256, 0);
  for (int i = 0; i < 60000; ++i) {
    const auto p = random_permutation(3, generator);
    ++met[p[0] * 16 + p[1] * 4 + p[2]];
  }
  CHECK(std::count_if(met.begin(), met.end(), [](int times) { return times > 9400 && times < 10600; }) == 6);
  CHECK(random_permutation(0, generator).empty());
}

TEST_CASE("random points are distinct and within bounds, also where half the cells are taken") {
  std::mt19937_64 generator(3);
  const std::int32_t end = GENERATE(8, 13, 16, 1 << 29, 1 << 30);
  const std::int32_t lowest = GENERATE(0, 1, 5);
  const std::int64_t cells = std::int64_t{end - lowest} * (end - lowest);
  const std::int64_t count = std::min<std::int64_t>(cells / 2, 10000);
  const std::vector<GridPoint> points = random_points(count, lowest, end, generator);
  CHECK(static_cast<std::int64_t>(points.size()) == count);
  CHECK(static_cast<std::int64_t>(std::set<GridPoint>(points.begin(), points.end()).size()) == count);
  for (const auto [x, y] : points) {
    CHECK((x >= lowest && x < end && y >= lowest && y < end));
  }
}

TEST_CASE("random points fill the square evenly") {
  std::mt19937_64 generator(4);
  const std::vector<GridPoint> points = random_points(64000, 0, 1 << 30, generator);
  std::vector<int> in_cell(64, 0);
  for (const auto [x, y] : points) {
    ++in_cell[(x >> 27) * 8 + (y >> 27)];
  }
  for (const int count : in_cell) {
    CHECK(count == Approx(1000).margin(200));
  }
}

}  // namespace trismooth::random_points_test

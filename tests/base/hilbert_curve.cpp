// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/hilbert_curve.h"

#include <cstdint>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "catch.h"

namespace trismooth::hilbert_curve_test {

using Cell = std::pair<std::uint32_t, std::uint32_t>;

/// The textbook recursion, one level at a time from the coarsest (Wikipedia's xy2d with its quadrant order).
std::uint64_t index_by_rotation(std::uint32_t x, std::uint32_t y, int order) {
  std::uint64_t index = 0;
  for (std::uint64_t half = std::uint64_t{1} << (order - 1); half > 0; half /= 2) {
    const std::uint64_t right = (x & half) != 0 ? 1 : 0;
    const std::uint64_t upper = (y & half) != 0 ? 1 : 0;
    index += half * half * ((3 * right) ^ upper);
    if (upper == 0) {
      if (right == 1) {
        x = static_cast<std::uint32_t>(half - 1) - (x & static_cast<std::uint32_t>(half - 1));
        y = static_cast<std::uint32_t>(half - 1) - (y & static_cast<std::uint32_t>(half - 1));
      }
      std::swap(x, y);
    }
  }
  return index;
}

TEST_CASE("the Hilbert curve visits every cell once, and each next cell shares a side with the last") {
  for (int order = 1; order <= 9; ++order) {
    CAPTURE(order);
    const std::uint32_t side = 1U << order;
    const Cell nowhere{side, side};
    std::vector<Cell> visited(std::size_t{side} * side, nowhere);
    for (std::uint32_t x = 0; x < side; ++x) {
      for (std::uint32_t y = 0; y < side; ++y) {
        const std::uint64_t index = hilbert_index(x, y, order);
        REQUIRE(index < visited.size());
        REQUIRE(visited[index] == nowhere);
        visited[index] = {x, y};
      }
    }
    for (std::size_t i = 1; i < visited.size(); ++i) {
      const auto dx = std::int64_t{visited[i].first} - std::int64_t{visited[i - 1].first};
      const auto dy = std::int64_t{visited[i].second} - std::int64_t{visited[i - 1].second};
      REQUIRE(std::abs(dx) + std::abs(dy) == 1);
    }
    CHECK(visited.front() == Cell{0, 0});
    CHECK(visited.back() == Cell{side - 1, 0});
  }
}

TEST_CASE("the Hilbert index equals that of the level-by-level recursion at every order") {
  std::mt19937_64 bits(1);
  for (int order = 1; order <= 32; ++order) {
    CAPTURE(order);
    for (int i = 0; i < 2000; ++i) {
      const auto x = static_cast<std::uint32_t>(bits() >> (64 - order));
      const auto y = static_cast<std::uint32_t>(bits() >> (64 - order));
      REQUIRE(hilbert_index(x, y, order) == index_by_rotation(x, y, order));
    }
  }
}

TEST_CASE("a cell's Hilbert index starts with that of the coarser cell that holds it") {
  std::mt19937_64 bits(2);
  for (int i = 0; i < 2000; ++i) {
    const auto x = static_cast<std::uint32_t>(bits() >> 32);
    const auto y = static_cast<std::uint32_t>(bits() >> 32);
    for (int order = 1; order < 32; ++order) {
      const int levels = 32 - order;
      REQUIRE(hilbert_index(x, y) >> (2 * levels) == hilbert_index(x >> levels, y >> levels, order));
    }
  }
}

}  // namespace trismooth::hilbert_curve_test

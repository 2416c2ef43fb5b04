// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/joined_blocks.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/base/splitmix64.h"

#include "catch.h"

using trismooth::joined_blocks;
using trismooth::joined_lists;
using trismooth::joined_sum;
using trismooth::ordered_sum;
using trismooth::splitmix64;
using trismooth::Workers;

TEST_CASE("what blocks find is put together, each number looked at once") {
  for (const int threads : {1, 2, 8}) {
    Workers workers(threads);
    for (const std::int64_t size : {0, 1, 64, 65, 100001}) {
      CAPTURE(threads, size);
      const auto largest = joined_blocks(
          size, 64, workers, std::int64_t{-1},
          [](std::int64_t /*begin*/, std::int64_t end, std::int64_t& found) { found = std::max(found, end - 1); },
          [](std::int64_t& all, std::int64_t found) { all = std::max(all, found); });
      CHECK(largest == size - 1);
      CHECK(joined_sum(size, 64, workers, [](std::int64_t i) { return i; }) == size * (size - 1) / 2);
      std::vector<std::int64_t> even =
          joined_lists<std::int64_t>(size, 64, workers, [](std::int64_t i, std::vector<std::int64_t>& found) {
            if (i % 2 == 0) {
              found.push_back(i / 2);
            }
          });
      std::ranges::sort(even);
      std::vector<std::int64_t> expected(static_cast<std::size_t>((size + 1) / 2));
      std::iota(expected.begin(), expected.end(), 0);
      CHECK(even == expected);
    }
  }
}

TEST_CASE("a sum in order has the same bits for every number of threads") {
  const auto term = [](std::int64_t i) { return 1 / static_cast<double>(splitmix64(static_cast<std::uint64_t>(i))); };
  for (const std::int64_t count : {0, 1, 1024, 1025, 100001}) {
    Workers one(1);
    const double expected = ordered_sum(count, term, one);
    for (const int threads : {2, 8}) {
      Workers workers(threads);
      CHECK(ordered_sum(count, term, workers) == expected);
    }
  }
}

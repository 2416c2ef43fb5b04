// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/prefix_sums.h"

#include <atomic>
#include <cstdint>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/splitmix64.h"

#include "catch.h"

using trismooth::Blocks;
using trismooth::for_each_numbered;
using trismooth::numbers_of;
using trismooth::prefix_sums;
using trismooth::splitmix64;
using trismooth::Workers;

TEST_CASE("blocks cover a range in order, and are visited once each") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (const std::int64_t size : {0, 1, 64, 65, 1000, 100001}) {
      CAPTURE(threads, size);
      const Blocks blocks(size, 64, workers);
      REQUIRE(blocks.count() >= 1);
      REQUIRE(blocks.begin(0) == 0);
      REQUIRE(blocks.begin(blocks.count()) == size);
      std::vector<int> visits(static_cast<std::size_t>(size), 0);
      std::atomic<std::int64_t> elsewhere{0};  // Catch's own checks are for one thread
      blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        elsewhere += begin != blocks.begin(block) || end != blocks.begin(block + 1) ? 1 : 0;
        for (std::int64_t i = begin; i < end; ++i) {
          ++visits[i];
        }
      });
      REQUIRE(elsewhere == 0);
      REQUIRE(visits == std::vector<int>(visits.size(), 1));
    }
  }
}

TEST_CASE("prefix sums are those of a loop, for every number of threads") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (const std::int64_t size : {0, 1, 32768, 32769, 300000}) {
      CAPTURE(threads, size);
      std::vector<std::int64_t> sums(static_cast<std::size_t>(size) + 1, -1);
      const auto of = [](std::int64_t i) { return splitmix64(static_cast<std::uint64_t>(i)) % 9; };
      prefix_sums<std::int64_t>(sums, of, workers);
      std::int64_t sum = 0;
      for (std::int64_t i = 0; i < size; ++i) {
        REQUIRE(sums[i] == sum);
        sum += static_cast<std::int64_t>(of(i));
      }
      REQUIRE(sums[size] == sum);
    }
  }
}

TEST_CASE("what counts is numbered in order, for every number of threads") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (const std::int64_t size : {0, 1, 32769, 300000}) {
      for (const std::uint64_t of_three : {0, 1, 3}) {
        CAPTURE(threads, size, of_three);
        const auto counts = [=](std::int64_t i) { return splitmix64(static_cast<std::uint64_t>(i)) % 3 < of_three; };
        std::vector<std::int32_t> expected;
        for (std::int64_t i = 0; i < size; ++i) {
          if (counts(i)) {
            expected.push_back(static_cast<std::int32_t>(i));
          }
        }
        CHECK(numbers_of(size, counts, workers) == expected);
        std::vector<std::int32_t> visited(expected.size(), -1);
        const std::int64_t found = for_each_numbered(
            size, counts, [&](std::int64_t number, std::int64_t i) { visited[number] = static_cast<std::int32_t>(i); },
            workers);
        CHECK(found == std::ssize(expected));
        CHECK(visited == expected);
      }
    }
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <tbb/task_arena.h>

#include "catch.h"

using trismooth::Workers;

TEST_CASE("a loop visits every element once, in parts of at least half the grain") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (const std::int64_t size : {0, 1, 7, 64, 65, 1000, 100001}) {
      CAPTURE(threads, size);
      std::vector<int> visits(static_cast<std::size_t>(size), 0);
      std::atomic<bool> small_part{false};
      workers.for_blocks(size, 64, [&](std::int64_t begin, std::int64_t end) {
        if (end - begin < std::min<std::int64_t>(size, 32)) {
          small_part = true;
        }
        for (std::int64_t i = begin; i < end; ++i) {
          ++visits[i];
        }
      });
      CHECK(std::ranges::all_of(visits, [](int count) { return count == 1; }));
      CHECK_FALSE(small_part);
    }
  }
}

TEST_CASE("one thread, or no more than the grain, is the calling thread in one part") {
  for (const int threads : {1, 4}) {
    Workers workers(threads);
    const std::int64_t size = threads == 1 ? 100000 : 64;
    const auto caller = std::this_thread::get_id();
    int parts = 0;
    workers.for_blocks(size, 64, [&](std::int64_t begin, std::int64_t end) {
      ++parts;
      CHECK(begin == 0);
      CHECK(end == size);
      CHECK(std::this_thread::get_id() == caller);
    });
    CHECK(parts == 1);
  }
}

TEST_CASE("a thread refused when loops have long been running is a lack of memory, which callers know how to tell") {
  Workers workers(2);
  const auto refuse = [](std::int64_t begin, std::int64_t /*end*/) {
    if (begin == 0) {
      throw std::runtime_error("pthread_create has failed: Resource temporarily unavailable");  // TBB's words
    }
  };
  CHECK_THROWS_AS(workers.for_blocks(1000, 1, refuse), std::bad_alloc);
}

TEST_CASE("the number of threads is the one asked for, or all for 0") {
  CHECK(Workers(0).count() == tbb::this_task_arena::max_concurrency());
  CHECK(Workers(1).count() == 1);
  CHECK(Workers(3).count() == 3);
}

TEST_CASE("more threads than cores are really started") {
  const int threads = tbb::this_task_arena::max_concurrency() + 2;
  Workers workers(threads);
  std::atomic<int> inside{0};
  std::atomic<bool> together{false};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  // Each part waits for the others: that ends early only if as many threads as parts are at it at the same time.
  workers.for_blocks(std::int64_t{64} * threads, 1, [&](std::int64_t, std::int64_t) {
    ++inside;
    while (!together && std::chrono::steady_clock::now() < give_up) {
      if (inside >= threads) {
        together = true;
      }
      std::this_thread::yield();
    }
    --inside;
  });
  CHECK(together);
}

TEST_CASE("loops inside one call of run are loops all the same") {
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    std::atomic<std::int64_t> sum{0};
    workers.run([&] {
      for (int i = 0; i < 100; ++i) {
        workers.for_blocks(1000, 10, [&](std::int64_t begin, std::int64_t end) { sum += end - begin; });
      }
    });
    CHECK(sum == 100000);
  }
}

TEST_CASE("an exception in a loop reaches the caller") {
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    const auto loop = [&] {
      workers.for_blocks(1000, 10, [](std::int64_t begin, std::int64_t end) {
        if (begin <= 500 && 500 < end) {
          throw std::runtime_error("at 500");
        }
      });
    };
    CHECK_THROWS_WITH(loop(), "at 500");
    CHECK_THROWS_AS(workers.run(loop), std::runtime_error);
  }
}

TEST_CASE("blocks in order are each worked on once and handed on one behind the other, few at a time") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (const std::size_t count : {0, 1, 2, 3, 7, 500}) {
      for (const std::size_t places : {1, 2, 5, 1000}) {
        CAPTURE(threads, count, places);
        std::vector<std::atomic<int>> at_place(places);
        std::atomic<bool> shared_place{false};
        std::vector<std::size_t> values(count, 0);  // written by `work`, read by `then`
        std::vector<std::size_t> order;
        workers.for_blocks_in_order(
            count, places,
            [&](std::size_t block, std::size_t place) {
              if (++at_place[place] != 1) {
                shared_place = true;
              }
              values[block] += block + 1;
            },
            [&](std::size_t block, std::size_t place) {
              order.push_back(values[block]);
              --at_place[place];
            });
        CHECK_FALSE(shared_place);
        std::vector<std::size_t> expected(count);
        std::iota(expected.begin(), expected.end(), std::size_t{1});
        CHECK(order == expected);
      }
    }
  }
}

TEST_CASE("blocks in order are worked on by many threads at a time, while others are handed on") {
  const int threads = 3;
  Workers workers(threads);
  std::atomic<int> inside{0};
  std::atomic<bool> together{false};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  const auto meet = [&](std::size_t /*block*/, std::size_t /*place*/) {
    ++inside;
    while (!together && std::chrono::steady_clock::now() < give_up) {
      together = together || inside >= threads;
      std::this_thread::yield();
    }
    --inside;
  };
  // The first block is handed on while others are at work: only then are there three.
  workers.for_blocks_in_order(
      100, 100,
      [&](std::size_t block, std::size_t place) {
        if (block > 0) {
          meet(block, place);
        }
      },
      meet);
  CHECK(together);
}

TEST_CASE("no block in order begins before there is a place for it") {
  const std::size_t places = 2;
  Workers workers(4);
  std::atomic<std::size_t> begun{0};
  std::atomic<bool> too_early{false};
  workers.for_blocks_in_order(
      20, places, [&](std::size_t /*block*/, std::size_t /*place*/) { ++begun; },
      [&](std::size_t block, std::size_t /*place*/) {
        // The others would go on now, if they could.
        for (int i = 0; i < 5000 && !too_early; ++i) {
          too_early = begun > block + places;
          std::this_thread::yield();
        }
      });
  CHECK_FALSE(too_early);
  CHECK(begun == 20);
}

TEST_CASE("of blocks in order the first that fails is the last one, and its exception reaches the caller") {
  for (const int threads : {1, 2, 8}) {
    Workers workers(threads);
    for (std::size_t round = 0; round < 200; ++round) {
      const std::size_t in_work = round % 50;
      const std::size_t in_then = 7 * round % 50;
      CAPTURE(threads, in_work, in_then);
      std::size_t handed_on = 0;
      const auto loop = [&] {
        workers.for_blocks_in_order(
            50, 1 + round % 9,
            [&](std::size_t block, std::size_t) {
              if (block >= in_work) {
                throw std::runtime_error("work " + std::to_string(block));
              }
            },
            [&](std::size_t block, std::size_t) {
              if (block == in_then) {
                throw std::runtime_error("then " + std::to_string(block));
              }
              ++handed_on;
            });
      };
      const bool then_first = in_then < in_work;
      CHECK_THROWS_WITH(loop(), then_first ? "then " + std::to_string(in_then) : "work " + std::to_string(in_work));
      CHECK(handed_on == std::min(in_work, in_then));
    }
  }
}

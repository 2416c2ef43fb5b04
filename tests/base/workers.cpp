#include "trismooth/base/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <new>
#include <stdexcept>
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

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/call_limit.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"

using trismooth::CallEnd;
using trismooth::CallEnded;
using trismooth::CallLimit;
using trismooth::Workers;

namespace trismooth::call_limit_test {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr std::int64_t many = 100000;

/// How a loop of some parts ended; none: it came to its end.
std::optional<CallEnd> end_of_loop(Workers& workers, std::atomic<std::int64_t>& visited) {
  try {
    workers.for_blocks(many, 64, [&](std::int64_t begin, std::int64_t end) { visited += end - begin; });
  } catch (const CallEnded& ended) {
    return ended.end;
  }
  return std::nullopt;
}

TEST_CASE("a loop of a call whose time is up is left before it begins, on any number of threads") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    std::atomic<std::int64_t> visited{0};
    {
      const CallLimit limit(0, {});
      CHECK(end_of_loop(workers, visited) == CallEnd::time_is_up);
      CHECK(visited == 0);
      CHECK(CallLimit::is_over());
    }
    CHECK_FALSE(CallLimit::is_over());
    CHECK(end_of_loop(workers, visited) == std::nullopt);
    CHECK(visited == many);
  }
}

TEST_CASE("a loop of a call that has time visits every element once, in parts of at least half the grain") {
  const CallLimit limit(no_limit, [] { return false; });
  for (const int threads : {1, 2, 8}) {
    Workers workers(threads);
    for (const std::int64_t size : {1, 63, 64, 65, 1000, 100001}) {
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

TEST_CASE("a call is cancelled in the midst of a loop, and asks on the thread that it was made on") {
  for (const int threads : {1, 4}) {
    Workers workers(threads);
    std::atomic<std::int64_t> parts{0};
    std::atomic<bool> is_asked_elsewhere{false};
    const CallLimit limit(no_limit, [&, caller = std::this_thread::get_id()] {
      is_asked_elsewhere = is_asked_elsewhere || std::this_thread::get_id() != caller;
      return parts > 0;
    });
    const auto slow = [&](std::int64_t, std::int64_t) {
      ++parts;
      std::this_thread::sleep_for(std::chrono::milliseconds(6));
    };
    CHECK_THROWS_AS(workers.for_blocks(64, 1, slow), CallEnded);
    CHECK(parts > 0);
    CHECK(parts < 64);
    CHECK_FALSE(is_asked_elsewhere);
  }
}

TEST_CASE("what a call's caller throws when asked leaves the loop") {
  for (const int threads : {1, 2}) {
    Workers workers(threads);
    const CallLimit limit(no_limit, []() -> bool { throw std::runtime_error("interrupted"); });
    CHECK_THROWS_WITH(workers.for_blocks(many, 64, [](std::int64_t, std::int64_t) {}), "interrupted");
  }
}

TEST_CASE("a call that is lifted runs to its end, and still knows that its time is up") {
  for (const int threads : {1, 2}) {
    Workers workers(threads);
    std::atomic<std::int64_t> visited{0};
    CallLimit limit(0, {});
    limit.lift();
    CHECK(end_of_loop(workers, visited) == std::nullopt);
    CHECK(visited == many);
    CHECK(limit.end() == CallEnd::time_is_up);
    CHECK(CallLimit::is_over());
  }
}

TEST_CASE("a limit is that of its thread, of the innermost call, and not of what the caller does when asked") {
  Workers workers(1);
  std::atomic<std::int64_t> visited{0};
  const CallLimit outer(0, {});
  {
    const CallLimit inner(no_limit, {});
    CHECK(end_of_loop(workers, visited) == std::nullopt);
  }
  CHECK(end_of_loop(workers, visited) == CallEnd::time_is_up);
  std::thread([&] { CHECK(end_of_loop(workers, visited) == std::nullopt); }).join();
  {
    const CallLimit::Hidden hidden;
    CHECK(end_of_loop(workers, visited) == std::nullopt);
  }
  bool was_asked = false;
  CallLimit asking(no_limit, [&] {
    was_asked = true;
    return CallLimit::current() != nullptr || end_of_loop(workers, visited).has_value();
  });
  CHECK(end_of_loop(workers, visited) == std::nullopt);
  CHECK(was_asked);
}

TEST_CASE("a limit counts from the moment that it is given") {
  const CallLimit whole(no_limit, {}, CallLimit::Clock::now() - std::chrono::seconds(10));
  CHECK(whole.seconds() >= 10);
  const CallLimit part(9, {}, CallLimit::begin_of_current());
  CHECK(CallLimit::is_over());
}

TEST_CASE("a part of a call has a time of its own, and what the caller says in it is said of the whole call") {
  int questions = 0;
  CallLimit whole(
      no_limit,
      [&] {
        ++questions;
        return true;
      },
      CallLimit::Clock::now() - std::chrono::seconds(10));
  {
    CallLimit soon(9, whole);
    CHECK(soon.end() == CallEnd::time_is_up);
  }
  CHECK(questions == 0);
  {
    CallLimit late(20, whole);
    CHECK(late.end() == CallEnd::cancelled);
  }
  CHECK(whole.end() == CallEnd::cancelled);
  CHECK(questions == 1);
}

}  // namespace trismooth::call_limit_test

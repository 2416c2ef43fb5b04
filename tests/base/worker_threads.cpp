// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/worker_threads.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include "trismooth/base/machine/workers.h"

#include "catch.h"

using trismooth::Workers;

namespace {

/// Of a hidden case of this program, run as a program of its own (in a fork of this one the threads of earlier cases
/// would be missing): its exit status, or minus the signal that ended it.
int outcome_of(const char* hidden_case, const std::string& setting) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("TRISMOOTH_TEST_SETTING", setting.c_str(), 1);
    ::execl("/proc/self/exe", "test_base", hidden_case, nullptr);
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

constexpr int cannot_be_told = 77;

bool loops_visit_everything(int threads) {
  for (int round = 0; round < 50; ++round) {
    Workers workers(threads);
    std::atomic<std::int64_t> sum{0};
    workers.run([&] {
      for (int i = 0; i < 20; ++i) {
        workers.for_blocks(10000, 10, [&](std::int64_t begin, std::int64_t end) { sum += end - begin; });
      }
    });
    if (sum != 200000) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("loops in a forked process visit everything, where threads were at work before") {
  Workers workers(4);
  const auto visits_all = [](Workers& these) {
    std::atomic<std::int64_t> sum{0};
    these.for_blocks(10000, 10, [&](std::int64_t begin, std::int64_t end) { sum += end - begin; });
    these.run([&] { these.for_blocks(10000, 10, [&](std::int64_t begin, std::int64_t end) { sum += end - begin; }); });
    std::int64_t in_order = 0;
    these.for_blocks_in_order(
        100, 3, [&](std::size_t, std::size_t) { ++sum; },
        [&](std::size_t block, std::size_t) { in_order += static_cast<std::int64_t>(block); });
    return sum == 20100 && in_order == 4950;
  };
  REQUIRE(visits_all(workers));
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);  // ends it where it hangs
    Workers later(4);
    ::_exit(visits_all(workers) && visits_all(later) && trismooth::has_lost_threads() ? 0 : 1);
  }
  int status = -1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK_FALSE(trismooth::has_lost_threads());
  CHECK(visits_all(workers));
}

TEST_CASE("threads that the system does not refuse may all be asked for") {
  CHECK(trismooth::start_worker_threads(1) == 1);
  CHECK(trismooth::start_worker_threads(5) == 5);
  CHECK(trismooth::start_worker_threads(3) == 3);
  CHECK(trismooth::allowed_threads(12) == 12);
}

TEST_CASE("threads that are busy have not been refused") {
  // All that TBB has are in loops, of which each asks for more.
  constexpr int wanted = 30;
  std::atomic<int> allowed{0};
  tbb::parallel_for(tbb::blocked_range<int>(0, 16, 1), [&](const auto&) {
    int fewest = allowed;
    const int mine = trismooth::start_worker_threads(wanted);
    while (!allowed.compare_exchange_weak(fewest, fewest == 0 ? mine : std::min(fewest, mine))) {
    }
  });
  CHECK(allowed == wanted);
  CHECK(trismooth::allowed_threads(wanted) == wanted);
  CHECK(loops_visit_everything(4));
}

TEST_CASE("refused threads", "[.]") {
  const char* const setting = std::getenv("TRISMOOTH_TEST_SETTING");
  REQUIRE(setting != nullptr);
  const auto mebibytes = static_cast<rlim_t>(std::stoul(setting));
  std::uint64_t pages = 0;
  REQUIRE(std::ifstream("/proc/self/statm") >> pages);
  if (pages >> 28U > 0) {
    ::_exit(cannot_be_told);  // a sanitizer, to which addresses are free
  }
  rlimit limit{};
  limit.rlim_cur = limit.rlim_max = pages * static_cast<rlim_t>(::getpagesize()) + (mebibytes << 20U);
  REQUIRE(::setrlimit(RLIMIT_AS, &limit) == 0);
  constexpr int wanted = 40;
  CHECK(loops_visit_everything(wanted));
  CHECK(trismooth::allowed_threads(wanted) < wanted);
  CHECK(Workers(wanted).count() < wanted);
}

TEST_CASE("where the system refuses threads, loops run on fewer") {
  // Each thread takes 4 MiB of addresses for its stack; so few that the first, or a later one, is refused, and
  // enough for what the loops themselves take.
  for (const int mebibytes : {6, 18, 40}) {
    CAPTURE(mebibytes);
    const int outcome = outcome_of("refused threads", std::to_string(mebibytes));
    CHECK((outcome == 0 || outcome == cannot_be_told));
  }
}

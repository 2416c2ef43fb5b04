#include "trismooth/base/worker_threads.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <functional>

#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include "trismooth/base/workers.h"

#include "catch.h"

using trismooth::Workers;

namespace {

/// The exit status of a child process that ran `body`, or minus the signal that ended it.
int outcome_of(const std::function<int()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(body());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

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

TEST_CASE("where the system refuses threads, loops run on fewer") {
  // Each thread takes 4 MiB of addresses for its stack; so few that the first, or a later one, is refused, and
  // enough for what the loops themselves take.
  for (const rlim_t mebibytes : {6, 18, 40}) {
    CAPTURE(mebibytes);
    const int outcome = outcome_of([mebibytes] {
      rlimit limit{};
      std::FILE* const file = std::fopen("/proc/self/statm", "r");
      unsigned long pages = 0;
      if (file == nullptr || std::fscanf(file, "%lu", &pages) != 1) {
        return 77;
      }
      std::fclose(file);
      if (pages >> 28U > 0) {
        return 77;  // a sanitizer, to which addresses are free
      }
      limit.rlim_cur = limit.rlim_max = pages * static_cast<rlim_t>(::getpagesize()) + (mebibytes << 20U);
      ::setrlimit(RLIMIT_AS, &limit);
      constexpr int wanted = 40;
      if (!loops_visit_everything(wanted)) {
        return 1;
      }
      return trismooth::allowed_threads(wanted) < wanted && Workers(wanted).count() < wanted ? 0 : 2;
    });
    CHECK((outcome == 0 || outcome == 77));
  }
}

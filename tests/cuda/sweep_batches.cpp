// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/sweeps/sweep_batches.h"

#include <cmath>
#include <limits>

#include "catch.h"

using trismooth::cuda::SweepBatches;

namespace {

constexpr double for_ever = std::numeric_limits<double>::infinity();

/// Launches until `sweeps` are done or the time is up, where each sweep takes so many seconds. Calls
/// launched(size, elapsed) after each.
template <class Launched>
void run(SweepBatches batches, std::int64_t sweeps, double seconds_a_sweep, double limit, const Launched& launched) {
  double elapsed = 0;
  while (sweeps > 0 && elapsed < limit) {
    const double seconds = seconds_a_sweep * batches.size();
    elapsed += seconds;
    sweeps -= batches.size();
    launched(batches.size(), elapsed);
    batches.adapt(seconds, elapsed);
  }
}

}  // namespace

TEST_CASE("where nobody is asked every launch makes as many sweeps as it may") {
  run({256, false, for_ever}, 10'000, 1, for_ever, [](int size, double) { CHECK(size == 256); });
}

TEST_CASE("a callback hears of quick sweeps in few batches, and of slow ones at least ten times a second") {
  int launches = 0;
  run({256, true, for_ever}, 1000, 2e-5, for_ever, [&](int, double) { ++launches; });
  CHECK(launches <= 10);
  for (const double seconds : {1e-3, 4e-3, 0.1, 3.0}) {
    CAPTURE(seconds);
    double last = 0;
    int launch = 0;
    run({256, true, for_ever}, 1000, seconds, for_ever, [&](int size, double elapsed) {
      CHECK((launch++ == 0 || size == 1 || elapsed - last <= 0.1));
      last = elapsed;
    });
  }
}

TEST_CASE("a time limit ends the run at most a hundredth of a second late, or a sweep") {
  for (const bool watched : {false, true}) {
    for (const double limit : {0.0, 1e-6, 0.01, 1.0, 60.0}) {
      for (const double seconds : {1e-5, 1e-3, 0.2}) {
        CAPTURE(watched, limit, seconds);
        double end = 0;
        run({256, watched, limit}, 1LL << 40, seconds, limit, [&](int, double elapsed) { end = elapsed; });
        CHECK(end >= limit);
        CHECK(end <= limit + std::max(0.0101, 1.01 * seconds));
      }
    }
  }
}

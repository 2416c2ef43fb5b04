// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/stopwatch.h"

#include <thread>

#include "catch.h"

using trismooth::Stopwatch;

TEST_CASE("a stopwatch counts from when it is made, and from the last lap") {
  Stopwatch watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double seconds = watch.seconds();
  const double milliseconds = watch.milliseconds();
  CHECK(seconds >= 0.02);
  CHECK(milliseconds >= 1000 * seconds);
  const double lap = watch.lap();
  CHECK(lap >= milliseconds);
  // Started anew: what has passed since is not what had passed before.
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const Stopwatch younger;
  const double since_lap = watch.milliseconds();
  CHECK(since_lap >= 5);
  CHECK(younger.milliseconds() <= watch.milliseconds());
}

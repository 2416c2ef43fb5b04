// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/wording.h"

#include "catch.h"

using trismooth::experiments::runs_text;
using trismooth::experiments::sweeps_text;

TEST_CASE("sweeps that differ between runs have their bounds") {
  CHECK(sweeps_text({49, 49, 49}) == "49");
  CHECK(sweeps_text({80.5, 75, 86}) == "80 (75-86)");
}

TEST_CASE("one run is no runs") {
  CHECK(runs_text(1) == "1 run");
  CHECK(runs_text(7) == "7 runs");
}

#include "trismooth/pipeline/bench/wording.h"

#include "catch.h"

using trismooth::bench::runs_text;
using trismooth::bench::size_text;
using trismooth::bench::sweeps_text;

TEST_CASE("sizes are written short where that is exact") {
  CHECK(size_text(4) == "4");
  CHECK(size_text(1'000) == "1K");
  CHECK(size_text(1'500) == "1.5K");
  CHECK(size_text(1'234) == "1,234");
  CHECK(size_text(50'000) == "50K");
  CHECK(size_text(1'000'000) == "1M");
  CHECK(size_text(2'500'000) == "2.5M");
  CHECK(size_text(9'999'000) == "9999K");
}

TEST_CASE("sweeps that differ between runs have their bounds") {
  CHECK(sweeps_text({49, 49, 49}) == "49");
  CHECK(sweeps_text({80.5, 75, 86}) == "80 (75-86)");
}

TEST_CASE("one run is no runs") {
  CHECK(runs_text(1) == "1 run");
  CHECK(runs_text(7) == "7 runs");
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/progress_text.h"

#include <string>

#include "catch.h"

using trismooth::experiments::ExperimentProgress;
using trismooth::experiments::progress_pieces;

namespace {

std::string progress_text(const ExperimentProgress& progress, int runs) {
  std::string text;
  for (const std::string& piece : progress_pieces(progress, runs)) {
    text += piece;
  }
  return text;
}

}  // namespace

TEST_CASE("the progress is a bar with the part done, the mesh, the case and the run") {
  CHECK(progress_text({0.4, 100'000, "GPU-AoS, Form A", 3}, 7) ==
        "[#####---------] 40 %  100K: GPU-AoS, Form A, run 3 of 7");
  CHECK(progress_text({0, 1'000, "generating the mesh", 0}, 7) == "[--------------] 0 %  1K: generating the mesh");
}

TEST_CASE("a bar is never longer than full, nor shorter than empty") {
  CHECK(progress_text({1.5, 1'000, "x", 0}, 7) == "[##############] 100 %  1K: x");
  CHECK(progress_text({-1, 1'000, "x", 0}, 7) == "[--------------] 0 %  1K: x");
}

TEST_CASE("the progress of the paper's experiments fits a narrow terminal, with the seconds behind it") {
  CHECK(progress_text({1, 100'000, "CDP-SoA, Form B unordered", 7}, 7).size() < 80 - 10);
}

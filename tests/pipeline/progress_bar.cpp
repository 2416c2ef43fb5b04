// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/progress_bar.h"

#include <chrono>
#include <sstream>
#include <string>

#include "catch.h"

namespace trismooth::progress_bar_test {

using namespace std::chrono_literals;

/// A bar on a string, with a clock that the test moves.
struct Scene {
  std::ostringstream terminal;
  ProgressBar::Clock::time_point now{};
  ProgressBar bar{{&terminal}, 1000, [this] { return now; }};

  /// What was drawn since the last call.
  std::string drawn() {
    std::string text = terminal.str();
    terminal.str("");
    return text;
  }
};

const std::string erased = "\r\x1b[K";

TEST_CASE("a stage is drawn in place as soon as it starts") {
  Scene scene;
  scene.now += 1500ms;
  scene.bar.stage_started(Stage::read);
  CHECK(scene.drawn() == erased + "reading ..., 1.5 s");
  scene.bar.stage_started(Stage::write);
  CHECK(scene.drawn() == erased + "writing ..., 1.5 s");
}

TEST_CASE("a sweep is drawn with its number, its moves and the time") {
  Scene scene;
  scene.now += 200ms;
  scene.bar.sweep_done({12, 9000, 3456, 0.1});
  CHECK(scene.drawn() == erased + "smoothing: sweep 12 of at most 1000, 3456 vertices moved, 0.2 s");
  scene.now += 200ms;
  scene.bar.sweep_done({13, 9, 1, 0.1});
  CHECK(scene.drawn() == erased + "smoothing: sweep 13 of at most 1000, 1 vertex moved, 0.4 s");
  // Ten times a second at most.
  scene.now += 99ms;
  scene.bar.sweep_done({14, 9, 1, 0.1});
  CHECK(scene.drawn().empty());
  scene.bar.erase();
  CHECK(scene.drawn() == erased);
}

TEST_CASE("without a sweep limit the number of the sweep stands alone") {
  std::ostringstream terminal;
  ProgressBar bar({&terminal}, 0, [] { return ProgressBar::Clock::time_point{}; });
  bar.sweep_done({12, 9000, 3456, 0.1});
  CHECK(terminal.str() == erased + "smoothing: sweep 12, 3456 vertices moved, 0.0 s");
}

}  // namespace trismooth::progress_bar_test

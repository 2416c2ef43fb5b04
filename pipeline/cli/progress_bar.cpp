// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/progress_bar.h"

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace trismooth {

namespace {

std::string_view describe(Stage stage) {
  switch (stage) {
    case Stage::read:
      return "reading";
    case Stage::topology:
      return "finding neighbours";
    case Stage::check_before:
      return "checking the quality";
    case Stage::smooth:
      return "smoothing";
    case Stage::check_after:
      return "checking the result";
    case Stage::write:
      break;
  }
  return "writing";
}

}  // namespace

ProgressBar::ProgressBar(Terminal terminal, std::int64_t max_sweeps)
    : line_(std::move(terminal)), max_sweeps_(max_sweeps) {}

ProgressBar::ProgressBar(Terminal terminal, std::int64_t max_sweeps, std::function<Clock::time_point()> now)
    : line_(std::move(terminal), std::move(now)), max_sweeps_(max_sweeps) {}

void ProgressBar::stage_started(Stage stage) {
  line_.draw({std::string(describe(stage)), " ..."});
}

void ProgressBar::sweep_done(const SweepRecord& record) {
  line_.draw_now_and_then({std::string(describe(Stage::smooth)), fmt::format(": sweep {}", record.sweep),
                           max_sweeps_ > 0 ? fmt::format(" of at most {}", max_sweeps_) : std::string(),
                           fmt::format(", {} {} moved", record.moved, record.moved == 1 ? "vertex" : "vertices")});
}

}  // namespace trismooth

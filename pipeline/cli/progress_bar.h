// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "trismooth/pipeline/cli/terminal_line.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// One line that says what a run is doing, redrawn in place on a terminal:
///
///     smoothing: sweep 12 of at most 1000, 3456 vertices moved, 0.8 s
///
/// A stage is drawn when it starts, its sweeps at most ten times a second; the time runs on in between. The destructor
/// erases the line.
class ProgressBar {
 public:
  using Clock = TerminalLine::Clock;

  /// `max_sweeps`: the sweep limit, 0: none. For the other arguments see TerminalLine.
  ProgressBar(Terminal terminal, std::int64_t max_sweeps);
  ProgressBar(Terminal terminal, std::int64_t max_sweeps, std::function<Clock::time_point()> now);

  void stage_started(Stage stage);
  void sweep_done(const SweepRecord& record);
  /// Until it is drawn again, for other text.
  void erase() { line_.erase(); }

 private:
  TerminalLine line_;
  std::int64_t max_sweeps_;
};

}  // namespace trismooth

#pragma once

#include <functional>
#include <ostream>

#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/terminal_line.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// One line that says what a run is doing, redrawn in place on a terminal:
///
///     smoothing: sweep 12, 3456 vertices moved, 0.8 s
///
/// A stage is drawn when it starts, its sweeps at most ten times a second. The destructor erases the line.
class ProgressBar {
 public:
  using Clock = TerminalLine::Clock;

  /// Draws on `terminal`, which must outlive it. `now` is asked for the time; tests hand in their own.
  explicit ProgressBar(std::ostream& terminal, std::function<Clock::time_point()> now = &Clock::now);

  void stage_started(Stage stage);
  void sweep_done(const SweepRecord& record);
  /// Until it is drawn again, for other text.
  void erase() { line_.erase(); }

 private:
  TerminalLine line_;
};

}  // namespace trismooth

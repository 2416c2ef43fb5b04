#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>

#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// One line that says what a run is doing, redrawn in place on a terminal:
///
///     smoothing: sweep 12, 3456 vertices moved, 0.8 s
///
/// A stage is drawn when it starts, its sweeps at most ten times a second. The destructor erases the line.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;

  /// Draws on `terminal`, which must outlive it. `now` is asked for the time; tests hand in their own.
  explicit ProgressBar(std::ostream& terminal, std::function<Clock::time_point()> now = &Clock::now);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  void stage_started(Stage stage);
  void sweep_done(const SweepRecord& record);

  /// Takes the line away, so that other text can be written; the next event draws it again.
  void erase();

 private:
  void draw(const std::string& what, Clock::time_point now);

  std::ostream& terminal_;
  std::function<Clock::time_point()> now_;
  Clock::time_point start_;
  Clock::time_point last_draw_;
  bool visible_ = false;
};

}  // namespace trismooth

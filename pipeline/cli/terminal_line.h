// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/pipeline/cli/ticker.h"
#include "trismooth/pipeline/report/terminal.h"

namespace trismooth {

/// Erases the line of a terminal on which something may stand: ECMA-48 EL.
inline constexpr std::string_view clear_line = "\r\x1b[K";

/// One line of a terminal that is redrawn in place, with the seconds since it was made at its end. They run on while
/// nothing is drawn. It stays on one line of any terminal: what the width does not hold is left out. The destructor
/// erases it. All functions may be called from any thread.
class TerminalLine {
 public:
  using Clock = std::chrono::steady_clock;
  /// Text in pieces that stand one behind the other; where there is no room for all, the last ones are left out.
  using Pieces = std::vector<std::string>;

  /// Draws on the terminal's stream, which is not null and must outlive it. Nobody else writes to that while the line
  /// is visible.
  explicit TerminalLine(Terminal terminal);
  /// A line for tests, with their own clock: it runs when tick() is called.
  TerminalLine(Terminal terminal, std::function<Clock::time_point()> now);
  TerminalLine(const TerminalLine&) = delete;
  TerminalLine& operator=(const TerminalLine&) = delete;
  ~TerminalLine();

  void draw(Pieces pieces);
  /// Draws if the last drawing was a tenth of a second ago, or else leaves it to the next tick: for what happens often.
  void draw_now_and_then(Pieces pieces);

  /// Draws the same again with the time of now, where the line is visible. Called ten times a second by itself.
  void tick();

  /// Until it is drawn again.
  void erase();

 private:
  void draw_at(Clock::time_point now);

  std::mutex mutex_;
  Terminal terminal_;
  std::function<Clock::time_point()> now_;
  Clock::time_point start_;
  Clock::time_point last_draw_;
  Pieces pieces_;
  bool visible_ = false;
  std::optional<Ticker> ticker_;  ///< the last: it is gone before the rest
};

}  // namespace trismooth

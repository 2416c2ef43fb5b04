#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string_view>

namespace trismooth {

/// Erases the line of a terminal on which something may stand: ECMA-48 EL.
inline constexpr std::string_view clear_line = "\r\x1b[K";

/// One line of a terminal that is redrawn in place, with the seconds since it was made at its end. The destructor
/// erases it.
class TerminalLine {
 public:
  using Clock = std::chrono::steady_clock;

  /// Draws on `terminal`, which must outlive it. `now` is asked for the time; tests hand in their own.
  explicit TerminalLine(std::ostream& terminal, std::function<Clock::time_point()> now = &Clock::now);
  TerminalLine(const TerminalLine&) = delete;
  TerminalLine& operator=(const TerminalLine&) = delete;
  ~TerminalLine();

  void draw(std::string_view text);
  /// Draws if the last drawing was a tenth of a second ago: for what happens often.
  void draw_now_and_then(std::string_view text);

  /// Until it is drawn again.
  void erase();

 private:
  void draw_at(std::string_view text, Clock::time_point now);

  std::ostream& terminal_;
  std::function<Clock::time_point()> now_;
  Clock::time_point start_;
  Clock::time_point last_draw_;
  bool visible_ = false;
};

}  // namespace trismooth

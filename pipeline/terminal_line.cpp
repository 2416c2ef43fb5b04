#include "trismooth/pipeline/terminal_line.h"

#include <utility>

#include <fmt/format.h>

namespace trismooth {

namespace {

constexpr std::chrono::milliseconds least_interval{100};

// Back to the start of the line, and erase to its end (ECMA-48 EL).
}  // namespace

TerminalLine::TerminalLine(std::ostream& terminal, std::function<Clock::time_point()> now)
    : terminal_(terminal), now_(std::move(now)), start_(now_()), last_draw_(start_ - least_interval) {}

TerminalLine::~TerminalLine() {
  erase();
}

void TerminalLine::draw(std::string_view text) {
  draw_at(text, now_());
}

void TerminalLine::draw_now_and_then(std::string_view text) {
  const Clock::time_point now = now_();
  if (now - last_draw_ >= least_interval) {
    draw_at(text, now);
  }
}

void TerminalLine::erase() {
  if (visible_) {
    terminal_ << clear_line << std::flush;
    visible_ = false;
  }
}

void TerminalLine::draw_at(std::string_view text, Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - start_).count();
  terminal_ << clear_line << fmt::format("{}, {:.1f} s", text, seconds) << std::flush;
  visible_ = true;
  last_draw_ = now;
}

}  // namespace trismooth

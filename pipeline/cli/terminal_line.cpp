// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/terminal_line.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace trismooth {

namespace {

constexpr std::chrono::milliseconds least_interval{100};

/// As many of the pieces as fit, with the time behind them; less than that where not even the first one does.
std::string fitting(const TerminalLine::Pieces& pieces, const std::string& time, std::size_t columns) {
  std::string text;
  for (const std::string& piece : pieces) {
    if (!text.empty() && text.size() + piece.size() + time.size() > columns) {
      break;
    }
    text += piece;
  }
  if (text.size() + time.size() <= columns) {
    return text + time;
  }
  constexpr std::string_view mark = "..";
  constexpr std::size_t least_text = 8;  // of less nobody makes sense
  const bool has_time = columns >= least_text + mark.size() + time.size();
  const std::size_t room = columns - (has_time ? time.size() : 0);
  if (text.size() > room) {
    text.resize(room - std::min(room, mark.size()));
    text += mark.substr(0, room);
  }
  return has_time ? text + time : text;
}

}  // namespace

TerminalLine::TerminalLine(Terminal terminal) : TerminalLine(std::move(terminal), &Clock::now) {
  ticker_.emplace(least_interval, [this] { tick(); });
}

TerminalLine::TerminalLine(Terminal terminal, std::function<Clock::time_point()> now)
    : terminal_(std::move(terminal)), now_(std::move(now)), start_(now_()), last_draw_(start_ - least_interval) {}

TerminalLine::~TerminalLine() {
  erase();
}

void TerminalLine::draw(Pieces pieces) {
  const std::lock_guard lock(mutex_);
  pieces_ = std::move(pieces);
  visible_ = true;
  draw_at(now_());
}

void TerminalLine::draw_now_and_then(Pieces pieces) {
  const std::lock_guard lock(mutex_);
  pieces_ = std::move(pieces);
  visible_ = true;
  const Clock::time_point now = now_();
  if (now - last_draw_ >= least_interval) {
    draw_at(now);
  }
}

void TerminalLine::tick() {
  const std::lock_guard lock(mutex_);
  if (visible_) {
    draw_at(now_());
  }
}

void TerminalLine::erase() {
  const std::lock_guard lock(mutex_);
  if (visible_) {
    *terminal_.stream << clear_line << std::flush;
    visible_ = false;
  }
}

void TerminalLine::draw_at(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - start_).count();
  // Some terminals go to the next line as soon as the last column is written to.
  const std::size_t columns = std::max<std::size_t>(terminal_.columns(), 2) - 1;
  // In one piece: where it takes several writes, an interrupt could come in between.
  *terminal_.stream << std::string(clear_line) + fitting(pieces_, fmt::format(", {:.1f} s", seconds), columns)
                    << std::flush;
  last_draw_ = now;
}

}  // namespace trismooth

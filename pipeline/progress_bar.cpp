#include "trismooth/pipeline/progress_bar.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace trismooth {

namespace {

constexpr std::chrono::milliseconds least_interval{100};

// Back to the start of the line, and erase to its end (ECMA-48 EL).
constexpr std::string_view clear_line = "\r\x1b[K";

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

ProgressBar::ProgressBar(std::ostream& terminal, std::function<Clock::time_point()> now)
    : terminal_(terminal), now_(std::move(now)), start_(now_()), last_draw_(start_ - least_interval) {}

ProgressBar::~ProgressBar() {
  erase();
}

void ProgressBar::stage_started(Stage stage) {
  draw(std::string(describe(stage)) + " ...", now_());
}

void ProgressBar::sweep_done(const SweepRecord& record) {
  const Clock::time_point now = now_();
  if (now - last_draw_ >= least_interval) {
    draw(fmt::format("{}: sweep {}, {} {} moved", describe(Stage::smooth), record.sweep, record.moved,
                     record.moved == 1 ? "vertex" : "vertices"),
         now);
  }
}

void ProgressBar::erase() {
  if (visible_) {
    terminal_ << clear_line << std::flush;
    visible_ = false;
  }
}

void ProgressBar::draw(const std::string& what, Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - start_).count();
  terminal_ << clear_line << fmt::format("{}, {:.1f} s", what, seconds) << std::flush;
  visible_ = true;
  last_draw_ = now;
}

}  // namespace trismooth

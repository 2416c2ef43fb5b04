#include "trismooth/pipeline/progress_bar.h"

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

ProgressBar::ProgressBar(std::ostream& terminal, std::function<Clock::time_point()> now)
    : line_(terminal, std::move(now)) {}

void ProgressBar::stage_started(Stage stage) {
  line_.draw(std::string(describe(stage)) + " ...");
}

void ProgressBar::sweep_done(const SweepRecord& record) {
  line_.draw_now_and_then(fmt::format("{}: sweep {}, {} {} moved", describe(Stage::smooth), record.sweep, record.moved,
                                      record.moved == 1 ? "vertex" : "vertices"));
}

}  // namespace trismooth

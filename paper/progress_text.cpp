// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/progress_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "trismooth/paper/wording.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth::experiments {

std::vector<std::string> progress_pieces(const ExperimentProgress& progress, int runs) {
  constexpr int bar_width = 14;
  const double part = std::clamp(progress.part, 0.0, 1.0);
  const auto done = static_cast<std::size_t>(part * bar_width);
  return {fmt::format("[{}{}] {:.0f} %", std::string(done, '#'), std::string(bar_width - done, '-'), 100 * part),
          fmt::format("  {}: {}", size_text(progress.vertices), progress.what),
          progress.run > 0 ? fmt::format(", run {} of {}", progress.run, runs) : std::string()};
}

}  // namespace trismooth::experiments

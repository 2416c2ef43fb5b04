// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/wording.h"

#include <fmt/format.h>

#include "trismooth/base/text/counted.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth::experiments {

std::string runs_text(int runs) {
  return counted(runs, "run", "runs");
}

std::string sweeps_text(const Spread& sweeps) {
  return sweeps.least == sweeps.most ? fmt::format("{:.0f}", sweeps.median)
                                     : fmt::format("{:.0f} ({:.0f}-{:.0f})", sweeps.median, sweeps.least, sweeps.most);
}

}  // namespace trismooth::experiments

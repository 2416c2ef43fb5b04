// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/pipeline/report/spread.h"

namespace trismooth::experiments {

/// Numbers as all reports of an experiment write them.

/// "49", or "49 (48-52)" where runs differ.
std::string sweeps_text(const Spread& sweeps);

/// "7 runs", "1 run".
std::string runs_text(int runs);

}  // namespace trismooth::experiments

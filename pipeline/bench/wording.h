#pragma once

#include <cstdint>
#include <string>

#include "trismooth/pipeline/bench/spread.h"

namespace trismooth::bench {

/// Numbers as all reports of an experiment write them.

/// "1K", "50K", "1.5M"; "1,234" where that would not be exact.
std::string size_text(std::int64_t vertices);

/// "49", or "49 (48-52)" where runs differ.
std::string sweeps_text(const Spread& sweeps);

/// "7 runs", "1 run".
std::string runs_text(int runs);

}  // namespace trismooth::bench

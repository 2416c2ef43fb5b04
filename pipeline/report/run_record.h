// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "trismooth/pipeline/gates.h"

namespace trismooth {

/// What a report says of a run beside the run's result.
struct RunRecord {
  std::string command{};             ///< that started it, as a shell reads it (see shell_words.h); may be empty
  std::string date{};                ///< when it started, see date_text(); may be empty
  std::vector<GateOutcome> gates{};  ///< in the order in which they were asked for
};

/// "2026-11-22T10:05:31+01:00": the time by this machine's clock and zone, as ISO 8601 writes it.
std::string date_text(std::chrono::system_clock::time_point time);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "trismooth/base/text/digits.h"

namespace trismooth {

/// What is said of a file of several time steps, whose last one is read, as by a run that goes on: "Values at nodes are
/// those of the last of 3 time steps, t = 120 (...)". `what`: "Values at nodes"; `format`: "SELAFIN".
inline std::string note_of_last_step(std::string_view what, std::size_t steps, std::optional<double> time,
                                     std::string_view format) {
  return std::string(what) + " are those of the last of " + std::to_string(steps) + " time steps" +
         (time ? ", t = " + shortest_text(*time) : "") + " (for another one, write it to a file of its own); " +
         std::string(format) + " output keeps those of all steps as they were read.";
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// Throws std::invalid_argument for the executions that no vertex slides with.
inline void require_sliding(const SmoothingOptions& options) {
  if (options.execution != Execution::resident) {
    throw std::invalid_argument("the paper's executions, single-block and cdp, know of no vertices that slide");
  }
}

/// Whether the device can do what the options ask for while vertices slide: the smallest shape counts elements without
/// a free vertex, which it takes for fixed.
inline bool can_slide(const SmoothingOptions& options) {
  return !options.measures_shape();
}

}  // namespace trismooth::cuda

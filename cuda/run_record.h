// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/sweeps/sweep_state.h"

namespace trismooth::cuda {

/// What a launch of sweeps and the guard behind it leave for the host, in one piece: one copy brings it over.
struct RunRecord {
  static constexpr std::int32_t most_sweeps = 256;

  LoopState state;
  GuardState guard;
  LineVerdict lines;
  std::array<SweepSums, most_sweeps> sums;
};

}  // namespace trismooth::cuda

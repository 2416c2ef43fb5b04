// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth::cuda {

/// What one thread did in a launch.
template <class T>
using ThreadTally = SweepTally<T, unsigned>;

}  // namespace trismooth::cuda

#pragma once

#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth::cuda {

/// What one thread did in a launch.
template <class T>
using ThreadTally = SweepTally<T, unsigned>;

/// Whether a move may be longer, relative to its neighbourhood, than `longest_squared`: only then is its quotient
/// divided. Exact: if the rounded moved / sum exceeds `longest_squared`, then moved > longest_squared * sum, and
/// rounding the product cannot bring it above `moved`, which is a number itself.
template <class T>
__device__ bool may_be_longer(const MoveLength<T>& length, T longest_squared) {
  return length.moved >= longest_squared * length.sum;
}

template <class T>
__device__ void add_move(ThreadTally<T>& tally, const MoveLength<T>& length, T tolerance) {
  ++tally.moved;
  tally.within_tolerance = tally.within_tolerance && length.is_within(tolerance);
  if (may_be_longer(length, tally.max_relative_squared)) {
    const T relative = length.relative_squared();
    tally.max_relative_squared = relative > tally.max_relative_squared ? relative : tally.max_relative_squared;
  }
}

}  // namespace trismooth::cuda

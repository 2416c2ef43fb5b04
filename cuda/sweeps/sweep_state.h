// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "trismooth/base/host_device.h"
#include "trismooth/cuda/primitives/falling_key.h"
#include "trismooth/smoothing/sweeps/stop_rule.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth::cuda {

/// What one sweep did, summed by atomics; all zeros to begin with. Sums and extremes do not depend on the order in
/// which threads add to them.
struct SweepSums {
  unsigned long long evaluated;
  unsigned long long moved;
  unsigned long long beyond_tolerance;  ///< moves larger than the tolerance
  unsigned long long max_relative;  ///< bits of the largest move^2 * k / sum |n_i - v|^2, as a double (not negative)
  unsigned long long min_quotient;  ///< falling_key() of the smallest quotient; 0: none was measured
};

/// How the sweeps of one run go on the device. In Form A (Jacobi) every move of a sweep is computed from the positions
/// before the sweep, out of one buffer into another. In Form B (coloured Gauss-Seidel) vertices move in place, colour
/// by colour; no two vertices of a colour share an element, so that their order does not matter.
struct LoopRules {
  bool swaps;                   ///< Form A, whose buffers swap; else Form B
  bool evaluates_all;           ///< every free vertex in every sweep
  bool begins_with_all;         ///< LoopState::evaluates_all is set
  bool measures_shape;          ///< fill SweepSums::min_quotient
  double tolerance;             ///< of SmoothingOptions
  double target;                ///< quality target, or no_target
  std::int64_t few_moves;       ///< Stages::few_moves()
  double fixed_quotient;        ///< smallest quotient of the triangles without a free vertex
  std::int32_t sweeps;          ///< at most so many before the host is asked; no more than there are SweepSums
  std::int64_t remaining;       ///< sweeps until the limit, those of this launch among them; 0: no limit
  std::int32_t batch_count;     ///< vertices of a batch are updated at the same time
  const std::int32_t* batches;  ///< on the device: batch b holds vertices batches[b] .. batches[b + 1]
};

/// Where a run stands. On the device; the host reads it between launches.
struct LoopState {
  static constexpr std::int32_t running = -1;
  /// The positions after the last sweep are those of two sweeps before, so all further sweeps go to and fro between the
  /// last two: nothing but the limit ends them. `current` is the buffer that will hold the positions then.
  static constexpr std::int32_t repeating = -2;

  std::int32_t sweeps = 0;      ///< done since the host last looked
  std::int32_t stop = running;  ///< a StopReason, running or repeating
  std::int32_t current = 0;     ///< which of the two buffers holds the positions
  std::int32_t batch = 0;       ///< the batch that comes next (CDP)
  std::int32_t error = 0;       ///< the cudaError_t of a launch by the device that failed
  std::uint64_t children = 0;   ///< kernels launched by the device

  // Of sweeps by the whole grid. The host hands them on from launch to launch.
  std::int32_t evaluates_all = 1;  ///< the next sweep evaluates every vertex
  std::int32_t marks = 0;          ///< and marks for the sweep after it, which will not
  std::uint32_t blocks_done = 0;   ///< blocks that have ended the sweep
};

/// What a sweep did, for the host: whose sweeps have working precision T.
template <class T>
SweepTally<T> tally_of(const SweepSums& sums) {
  return {static_cast<std::int64_t>(sums.evaluated), static_cast<std::int64_t>(sums.moved), sums.beyond_tolerance == 0,
          static_cast<T>(std::bit_cast<double>(sums.max_relative))};
}

/// The smallest shape after a sweep.
TRISMOOTH_HOST_DEVICE inline double min_shape_after(const SweepSums& sums, const LoopRules& rules) {
  return sums.min_quotient == 0 ? min_shape_of(std::numeric_limits<double>::infinity(), rules.fixed_quotient)
                                : min_shape_of(from_falling_key(sums.min_quotient), rules.fixed_quotient);
}

/// A StopReason, or LoopState::running.
TRISMOOTH_HOST_DEVICE inline std::int32_t stop_after(const SweepSums& sums, const LoopRules& rules) {
  const double min_shape = rules.measures_shape ? min_shape_after(sums, rules) : no_target;
  const auto reason = reason_in_sweep(static_cast<std::int64_t>(sums.moved), sums.beyond_tolerance == 0,
                                      rules.few_moves, min_shape, rules.target);
  return reason ? static_cast<std::int32_t>(*reason) : LoopState::running;
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace trismooth::cuda {

/// How many sweeps the device makes before the host looks in. Where nobody has to be asked: as many as a launch may.
/// A callback hears of sweeps in batches, some hundred times a second, so that it costs nothing; a clock is looked at
/// after the first sweep, and then as often, so that a run ends soon after its time is up.
class SweepBatches {
 public:
  /// `most`: sweeps of a launch. `watched`: there is a callback. The time limit in seconds may be infinite.
  SweepBatches(std::int32_t most, bool watched, double time_limit)
      : most_(most),
        time_limit_(time_limit),
        adapts_(watched || time_limit < std::numeric_limits<double>::infinity()),
        size_(!adapts_ ? most : (time_limit < std::numeric_limits<double>::infinity() ? 1 : std::min(most, first))) {}

  /// Sweeps of the next launch.
  std::int32_t size() const { return size_; }

  /// `seconds` went by for the last launch, `elapsed` since the start.
  void adapt(double seconds, double elapsed) {
    if (!adapts_) {
      return;
    }
    const double wanted = std::min(seconds_of_a_batch, time_limit_ - elapsed);
    const double fitting = seconds > 0 ? std::floor(size_ * (wanted / seconds)) : most_;
    // One batch may be slow or quick by accident.
    size_ = static_cast<std::int32_t>(std::clamp(fitting, 1.0, static_cast<double>(std::min(most_, 4 * size_))));
  }

 private:
  static constexpr std::int32_t first = 24;
  static constexpr double seconds_of_a_batch = 0.01;

  std::int32_t most_;
  double time_limit_;
  bool adapts_;
  std::int32_t size_;
};

}  // namespace trismooth::cuda

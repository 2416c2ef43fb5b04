#pragma once

#include <algorithm>
#include <cstdint>

#include "trismooth/smoothing/sweeps/stages.h"

namespace trismooth::cuda {

/// The stages of a run whose sweeps are launched many at a time.
class DeviceStages {
 public:
  DeviceStages(const SmoothingOptions& options, std::int64_t free_count)
      : stages_(options, free_count), left_(stages_.sweeps()) {}

  bool is_last() const { return stages_.is_last(); }
  std::int64_t few_moves() const { return stages_.few_moves(); }
  template <class T>
  MeanRatioStep<T> step() const {
    return stages_.step<T>();
  }
  /// How many of `sweeps` may be launched at a time.
  std::int32_t at_most(std::int32_t sweeps) const {
    return is_last() ? sweeps : static_cast<std::int32_t>(std::min<std::int64_t>(sweeps, left_));
  }
  /// Whether next() is due after a launch that made so many sweeps. `settled`: the last one ends the stage.
  bool is_over(std::int64_t sweeps, bool settled) {
    left_ -= sweeps;
    return !is_last() && (settled || left_ == 0);
  }
  void next(std::int64_t moved, bool settled) {
    stages_.next(moved, settled);
    left_ = stages_.sweeps();
  }

 private:
  Stages stages_;
  std::int64_t left_;  ///< until next(), where the stage is not the last
};

}  // namespace trismooth::cuda

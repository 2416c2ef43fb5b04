// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// The stages of a smoothing, one after the other: the mean-ratio method has two, the others have one that lasts to the
/// stop. A stage begins with a sweep over all vertices. Where a sweep moves nothing, or nothing beyond the tolerance, a
/// stage is over; the smoothing is if that was the last. In the last stage of the mean-ratio method so is one that
/// moves next to nothing: what is left to gain then is in the last digits.
///
/// The first stage of the mean-ratio method minimises the inverse mean ratio itself, which brings vertices where they
/// belong soonest, the last one a power of it, which sees to the worst triangles. The first lasts ten
/// sweeps. If more than 7/8 of the vertices still move then, the mesh has far to go: it takes smaller gains for moves
/// and goes on, ten sweeps at a time, while more than a quarter of the vertices move. So has one with sizes that are
/// asked for. (Found by experiment: docs/mean_ratio.md.) With MeanRatioOptions::steady the last stage is the only
/// one, and goes on until nothing moves.
class Stages {
 public:
  Stages(const SmoothingOptions& options, std::int64_t free_count)
      : is_mean_ratio_(options.method == Method::mean_ratio),
        is_form_a_(options.form == Form::swap),
        is_steady_(options.mean_ratio.steady),
        free_count_(free_count),
        is_last_(!is_mean_ratio_ || free_count == 0 || is_steady_),
        has_far_to_go_(options.aims_at_sizes()) {}

  /// Whether the stage lasts to the stop.
  bool is_last() const { return is_last_; }
  /// Sweeps after which next() is to be asked; 0: it lasts to the stop.
  std::int64_t sweeps() const { return is_last_ ? 0 : sweeps_of_first; }
  /// Where no more vertices move than so many the stage is over. Other methods go on until nothing moves.
  std::int64_t few_moves() const { return is_mean_ratio_ && is_last_ && !is_steady_ ? free_count_ / 64 : 0; }
  /// What the mean-ratio method does now.
  template <class T>
  MeanRatioStep<T> step() const {
    // A step of Form A does not see what the neighbours do at the same time: it falls short of Newton's, for together
    // they would go too far.
    const double relaxation = is_form_a_ ? 0.7 : (is_last_ ? 1.5 : 1.8);
    const double least_gain = has_far_to_go_ ? 1e-4 : 3e-4;
    return {static_cast<T>(relaxation), static_cast<T>(least_gain), is_last_, is_steady_};
  }
  /// The next stage, or the same once more. `moved`: vertices in the last sweep; `settled`: that sweep ended the stage,
  /// see settled_in_sweep(). Only where this one is not the last.
  void next(std::int64_t moved, bool settled) {
    const bool moves_much = has_far_to_go_ ? 4 * moved > free_count_ : 8 * moved > 7 * free_count_;
    const bool goes_on = moves_much && !settled;
    has_far_to_go_ = has_far_to_go_ || goes_on;
    is_last_ = !goes_on;
  }

 private:
  static constexpr std::int64_t sweeps_of_first = 10;

  bool is_mean_ratio_;
  bool is_form_a_;
  bool is_steady_;
  std::int64_t free_count_;
  bool is_last_;
  bool has_far_to_go_;
};

/// Whether vertices slide behind a sweep: every fifth of a stage (from 1), where it settles, and behind the last one
/// that may be. More often brings the elements no further (found by experiment: docs/sliding.md), and a device would
/// have to be asked as often.
constexpr bool slides_behind(std::int64_t sweep_of_stage, bool settled, bool is_limit) {
  constexpr std::int64_t every = 5;
  return sweep_of_stage % every == 0 || settled || is_limit;
}

}  // namespace trismooth

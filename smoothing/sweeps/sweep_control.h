// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "trismooth/base/machine/call_limit.h"
#include "trismooth/smoothing/halo/halo.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/sweeps/stages.h"
#include "trismooth/smoothing/sweeps/stop_rule.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth {

constexpr StopReason stop_reason(CallEnd end) {
  return end == CallEnd::cancelled ? StopReason::cancelled : StopReason::time_limit;
}

/// Leads a run, whoever makes its sweeps: told what each of them did, it keeps the record, and says which stage the
/// next one is of, when vertices slide, and when the run is over, and why. It knows of no vertex.
class SweepControl {
 public:
  /// `free_vertices`: of the whole mesh. `result` gets the counters, the history and the stop reason. `halo`: of a part
  /// of a mesh, whose other parts have controls of their own that are told the same; null: it is the whole. All outlive
  /// it. From now on nothing but a sweep ends the call: its limit is lifted. Where there is none it begins here.
  SweepControl(const SmoothingOptions& options, std::int64_t free_vertices, SmoothingResult& result,
               const Halo* halo = nullptr);

  /// Why a run with these options is over before its first sweep: this thread's call is, or has time for what comes
  /// behind the sweeps alone, as far as that is known.
  static std::optional<CallEnd> end_before_sweeps(const SmoothingOptions& options);

  /// What the next sweep is of.
  const Stages& stages() const { return stages_; }
  /// Whether the next sweep is the first of its stage.
  bool begins_stage() const { return sweeps_of_stage_ == 0; }

  /// As many of the next `sweeps` as there are up to the end of the stage and the limit; and if vertices slide, up to
  /// the next sweep that they slide behind however it settles.
  std::int64_t sweeps_until_asked(std::int64_t sweeps, bool slides) const;
  /// Sweeps until the limit; 0: there is none.
  std::int64_t sweeps_left() const { return options_.max_sweeps > 0 ? options_.max_sweeps - result_.sweeps : 0; }

  /// Whether a sweep that did this settles its stage.
  template <class T>
  bool settles(const SweepTally<T>& tally) const {
    return settled(tally.moved, tally.within_tolerance).has_value();
  }
  /// Whether vertices slide behind one of the sweeps to come, 1 being the next; `settled`: it settles the stage.
  bool slides_behind(std::int64_t sweep, bool settled) const {
    return trismooth::slides_behind(sweeps_of_stage_ + sweep, settled, result_.sweeps + sweep == options_.max_sweeps);
  }

  /// Since the call began, which the time limit is for.
  double seconds() const { return limit_->seconds(); }
  /// Whether the call is over before the first sweep; the result says why then.
  bool is_over();

  /// Takes in a sweep and what slid behind it. `min_shape`: after it, NaN where it was not measured; `seconds`: as
  /// seconds(), the most of all parts; none: nobody is to look at the clock, or to ask, now. True: the run is over, and
  /// the result says why.
  template <class T>
  bool add(const SweepTally<T>& tally, double min_shape, std::optional<double> seconds) {
    return add(SweepRecord{0, tally.evaluated, tally.moved, static_cast<double>(std::sqrt(tally.max_relative_squared)),
                           min_shape},
               settled(tally.moved, tally.within_tolerance), seconds);
  }
  /// Takes in a sweep that did what the one before the last did, and that settles nothing.
  bool add_again() { return add(result_.history[result_.history.size() - 2], std::nullopt, std::nullopt); }

 private:
  std::optional<StopReason> settled(std::int64_t moved, bool within_tolerance) const {
    return settled_in_sweep(moved, within_tolerance, stages_.few_moves());
  }
  bool add(SweepRecord record, std::optional<StopReason> settled, std::optional<double> seconds);
  /// Whether, after so many seconds, there is no time for another sweep and what comes behind it.
  bool is_up_after(double seconds);
  std::optional<StopReason> reason_to_stop(std::optional<StopReason> settled, const SweepRecord& record,
                                           std::optional<double> seconds);

  const SmoothingOptions& options_;
  SmoothingResult& result_;
  const Halo* halo_;
  Stages stages_;
  std::optional<CallLimit> own_limit_;  ///< of a run that is a call of its own
  CallLimit* limit_;
  double swept_until_ = 0;            ///< seconds of the call
  std::optional<double> first_took_;  ///< seconds of the first sweep
  std::int64_t sweeps_of_stage_ = 0;  ///< done
};

}  // namespace trismooth

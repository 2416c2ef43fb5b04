// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/sweep_control.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace trismooth {

SweepControl::SweepControl(const SmoothingOptions& options, std::int64_t free_vertices, SmoothingResult& result,
                           const Halo* halo)
    : options_(options), result_(result), halo_(halo), stages_(options, free_vertices), limit_(CallLimit::current()) {
  if (limit_ == nullptr) {
    limit_ = &own_limit_.emplace(options.time_limit_seconds, options.cancel);
  }
  limit_->lift();
}

std::int64_t SweepControl::sweeps_until_asked(std::int64_t sweeps, bool slides) const {
  if (!stages_.is_last()) {
    sweeps = std::min(sweeps, stages_.sweeps() - sweeps_of_stage_);
  }
  if (options_.max_sweeps > 0) {
    sweeps = std::min(sweeps, sweeps_left());
  }
  std::int64_t count = slides ? 1 : sweeps;
  while (count < sweeps && !slides_behind(count, false)) {
    ++count;
  }
  return count;
}

std::optional<CallEnd> SweepControl::end_before_sweeps(const SmoothingOptions& options) {
  CallLimit* const limit = CallLimit::current();
  if (limit == nullptr) {
    return std::nullopt;
  }
  const bool is_up = limit->seconds() + limit->kept_back().value_or(0) >= options.time_limit_seconds;
  return is_up ? CallEnd::time_is_up : limit->end();
}

bool SweepControl::is_over() {
  const std::optional<CallEnd> end = own_limit_ ? own_limit_->end() : end_before_sweeps(options_);
  swept_until_ = limit_->seconds();
  bool is_up = end == CallEnd::time_is_up;
  bool is_cancelled = end == CallEnd::cancelled;
  if (halo_ != nullptr && options_.time_limit_seconds < std::numeric_limits<double>::infinity()) {
    is_up = any_part(halo_, is_up);
  }
  if (halo_ != nullptr && halo_->part().has_progress) {
    is_cancelled = any_part(halo_, is_cancelled);
  }
  if (is_up || is_cancelled) {
    result_.stop_reason = stop_reason(is_up ? CallEnd::time_is_up : CallEnd::cancelled);
  }
  return is_up || is_cancelled;
}

bool SweepControl::add(SweepRecord record, std::optional<StopReason> settled, std::optional<double> seconds) {
  record.sweep = ++result_.sweeps;
  ++sweeps_of_stage_;
  result_.vertex_updates += record.evaluated;
  result_.history.push_back(record);
  if (const auto reason = reason_to_stop(stages_.is_last() ? settled : std::nullopt, record, seconds)) {
    result_.stop_reason = *reason;
    return true;
  }
  if (!stages_.is_last() && (settled || sweeps_of_stage_ == stages_.sweeps())) {
    stages_.next(record.moved, settled.has_value());
    sweeps_of_stage_ = 0;
  }
  return false;
}

bool SweepControl::is_up_after(double seconds) {
  if (halo_ != nullptr) {
    return seconds >= options_.time_limit_seconds;  // all that parts know in common
  }
  const double took = seconds - std::exchange(swept_until_, seconds);
  if (!first_took_) {
    first_took_ = took;
  }
  // The guard takes as long as one to three sweeps over all vertices, with what is written behind it.
  constexpr double sweeps_of_guard = 3;
  return seconds + took + limit_->kept_back().value_or(sweeps_of_guard * *first_took_) >= options_.time_limit_seconds;
}

std::optional<StopReason> SweepControl::reason_to_stop(std::optional<StopReason> settled, const SweepRecord& record,
                                                       std::optional<double> seconds) {
  bool stopped = options_.progress && options_.progress(record) == Progress::stop;
  stopped = stopped || (seconds && limit_->end() == CallEnd::cancelled);
  if (halo_ != nullptr && halo_->part().has_progress) {
    stopped = any_part(halo_, stopped);
  }
  if (settled) {
    return settled;
  }
  if (record.min_shape >= options_.target_quality.value_or(no_target)) {
    return StopReason::quality_target;
  }
  if (stopped) {
    return StopReason::cancelled;
  }
  if (record.sweep == options_.max_sweeps) {
    return StopReason::sweep_limit;
  }
  if (seconds && is_up_after(*seconds)) {
    return StopReason::time_limit;
  }
  return std::nullopt;
}

}  // namespace trismooth

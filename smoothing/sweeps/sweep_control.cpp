#include "trismooth/smoothing/sweeps/sweep_control.h"

#include <algorithm>

namespace trismooth {

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

bool SweepControl::add(SweepRecord record, std::optional<StopReason> settled, double seconds) {
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

std::optional<StopReason> SweepControl::reason_to_stop(std::optional<StopReason> settled, const SweepRecord& record,
                                                       double seconds) const {
  bool stopped = options_.progress && options_.progress(record) == Progress::stop;
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
  if (seconds >= options_.time_limit_seconds) {
    return StopReason::time_limit;
  }
  return std::nullopt;
}

}  // namespace trismooth

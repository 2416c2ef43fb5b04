// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string_view>

#include "trismooth/base/machine/call_limit.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/sweeps/sweep_control.h"

namespace trismooth {

/// Whether what is called now is part of a call that has limits already, and not of a callback of that.
inline bool is_part_of_call() {
  const CallLimit* const outer = CallLimit::current();
  return outer != nullptr && !outer->is_lifted();
}

/// The result of a call that was over before its first sweep.
inline SmoothingResult ended_before_sweeps(CallEnd end, std::string_view backend) {
  SmoothingResult result;
  result.stop_reason = stop_reason(end);
  result.backend = backend;
  result.inverted = -1;
  result.degenerate = -1;
  return result;
}

/// What smooth() answers, of that backend: of a call of the caller's within the limits of the options, whose result
/// says so where they end it before the first sweep; of a call that is part of another one within those of that.
template <class Smooth>
SmoothingResult limited(const SmoothingOptions& options, std::string_view backend, const Smooth& smooth) {
  if (is_part_of_call()) {
    return smooth();
  }
  const CallLimit limit(options.time_limit_seconds, options.cancel);
  try {
    return smooth();
  } catch (const CallEnded& ended) {
    return ended_before_sweeps(ended.end, backend);
  }
}

/// The plan that `make` makes: for a call of the caller's, who may cancel it, without a limit of time; for a call that
/// is part of another one within the limits of that. Throws PlanCancelled.
template <class Make>
auto planned(const SmoothingOptions& options, const Make& make) {
  if (is_part_of_call()) {
    return make();
  }
  const CallLimit limit(std::numeric_limits<double>::infinity(), options.cancel);
  try {
    return make();
  } catch (const CallEnded&) {
    throw PlanCancelled();
  }
}

}  // namespace trismooth

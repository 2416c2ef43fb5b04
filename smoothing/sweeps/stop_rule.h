// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "trismooth/base/host_device.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// A quality target that is never reached: no target.
inline constexpr double no_target = std::numeric_limits<double>::quiet_NaN();

/// Whether a sweep says that the stage of the smoothing is over, and with the last stage the smoothing. `few_moves`:
/// Stages::few_moves().
constexpr TRISMOOTH_HOST_DEVICE std::optional<StopReason> settled_in_sweep(std::int64_t moved, bool within_tolerance,
                                                                           std::int64_t few_moves) {
  if (moved == 0) {
    return StopReason::fixed_point;
  }
  if (within_tolerance) {
    return StopReason::tolerance;
  }
  if (moved <= few_moves) {
    return StopReason::few_moves;
  }
  return std::nullopt;
}

/// Why the smoothing ends with a sweep of its last stage, as far as the sweep itself says it; the reasons in their
/// order. Sweep limit, time limit and cancellation come after these. `min_shape` is the smallest shape after the sweep,
/// NaN where it was not measured.
constexpr TRISMOOTH_HOST_DEVICE std::optional<StopReason> reason_in_sweep(std::int64_t moved, bool within_tolerance,
                                                                          std::int64_t few_moves, double min_shape,
                                                                          double target) {
  if (const auto settled = settled_in_sweep(moved, within_tolerance, few_moves)) {
    return settled;
  }
  if (min_shape >= target) {
    return StopReason::quality_target;
  }
  return std::nullopt;
}

/// The smallest shape of a mesh from the smallest quotients of its triangles with and without a free vertex; NaN where
/// it has no triangles (both are infinite).
constexpr TRISMOOTH_HOST_DEVICE double min_shape_of(double free_quotient, double fixed_quotient) {
  const double quotient = fixed_quotient < free_quotient ? fixed_quotient : free_quotient;
  return quotient - quotient == 0 ? shape_constant * quotient : no_target;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <nanobind/nanobind.h>

#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::python {

/// What a smoothing hands to Python, beside the points.
struct Outcome {
  SmoothingResult smoothing;
  std::optional<QualityReport> before;  ///< where it was asked for
  std::optional<QualityReport> after;   ///< where it was asked for
  /// Of a mesh that followed its boundary; its `smoothing` is above.
  std::optional<FollowResult> followed;
};

/// Makes the classes of results: Outcome, SweepRecord, SlidingResult, QualityReport, MetricSummary, WorstElement; and
/// functions that say why sweeps ended and where lines are.
void bind_results(nanobind::module_& module);

}  // namespace trismooth::python

#pragma once

#include <optional>

#include <nanobind/nanobind.h>

#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::python {

/// What a smoothing hands to Python, beside the points.
struct Outcome {
  SmoothingResult smoothing;
  std::optional<QualityReport> before;  ///< where it was asked for
  std::optional<QualityReport> after;   ///< where it was asked for
};

/// Makes the classes of results: Outcome, SweepRecord, SlidingResult, QualityReport, MetricSummary, WorstElement.
void bind_results(nanobind::module_& module);

}  // namespace trismooth::python

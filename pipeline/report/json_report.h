// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/run_record.h"

namespace trismooth {

/// The report of a run as JSON for programs, indented, ending in a line feed. Its keys are stable and always there;
/// what a run does not have ("after", "smoothing" and the hashes where nothing was smoothed, min_shape of a sweep where
/// it was not recorded, limits that were not set) is null, as are numbers that are not finite. Numbers read back to the
/// same value. "options" states what took effect: the backend that ran, the threads that were used. Text that is not
/// UTF-8 (in file names) has U+FFFD in its place.
std::string json_report(const PipelineOptions& options, const PipelineResult& result, const RunRecord& record = {});

}  // namespace trismooth

#pragma once

#include <string>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// The result of a run for people, as the command line prints it: what was read, what was done, the quality before and
/// after, and what is left to know (nothing moved, inverted triangles remain, the file that was written). Ends in a
/// line feed. Of a run without smoothing: what was read and its quality.
std::string text_report(const PipelineOptions& options, const PipelineResult& result);

/// "0.42 ms", "13 ms", "2.1 s": a time with the digits that matter.
std::string duration_text(double milliseconds);

/// "nothing moved any more", ...: a stop reason in words.
std::string_view describe(StopReason reason);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// How much the text of a smoothing says.
enum class TextDetail : bool {
  summary,  ///< a line for each step, and whether it got better
  all,      ///< also how it was done, every metric, the histogram and the worst elements
};

/// The result of a run for people, as the command line prints it: what was read, what was held and why, what was done,
/// the quality before and after, and what is left to know (nothing moved, inverted triangles remain, the file that was
/// written). Ends in a line feed, and holds nothing that would steer a terminal. Of a run without smoothing: what was
/// read and its whole quality.
std::string text_report(const PipelineOptions& options, const PipelineResult& result, TextDetail detail);

/// "0.42 ms", "13 ms", "2.1 s": a time with the digits that matter.
std::string duration_text(double milliseconds);

/// Whether a device, not the CPU, ran the sweeps.
bool ran_on_device(const SmoothingResult& smoothing);

/// Who made the sweeps: "cpu with 2 threads"; a device by name alone, and whoever was not asked for any any more.
std::string who_smoothed(const SmoothingResult& smoothing);

/// "14 by the host, 120 by the device": kernel launches of a smoothing on a device.
std::string launches_text(const SmoothingResult& smoothing);

/// "12 triangles not valid before, 0 after it, 0 in the result": what untangling did.
std::string untangling_text(const SmoothingResult& smoothing);

/// "396 of 396 vertices on 4 lines slid, which are ..": what became of vertices that may slide.
std::string sliding_text(const PipelineResult& result);

/// How valid quadratic elements are, as a sentence; empty where the mesh has none.
std::string quadratic_text(const PipelineResult& result);

/// What every report says of a result that another run would not give.
std::string_view not_reproducible_text();

/// The mesh files that a run wrote, for people. It wrote some.
std::string shown_meshes(const PipelineOptions& options, const PipelineResult& result);

/// "nothing moved: no vertex could be improved", ...: why a run with smoothing moved nothing; empty where it did.
std::string_view why_nothing_moved(const PipelineResult& result);

}  // namespace trismooth

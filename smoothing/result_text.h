// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "trismooth/smoothing/result.h"

/// What people should know of a result, in a sentence each that is empty where there is nothing to say. Ways out are
/// options of the program; the Python package puts its arguments in their places (python/trismooth/_notes.py).
namespace trismooth {

/// Why the sweeps ended. Never empty.
std::string_view describe(StopReason reason);

/// Whether the time was up before the first sweep, and with it perhaps before all was untangled.
bool has_no_time_for_sweeps(const SmoothingResult& smoothing);

/// That there was no time for any sweep, and what came of it.
std::string no_time_text(const SmoothingResult& smoothing,
                         std::string_view consequence = "so no sweep has moved anything");

/// Nodes between corners that cannot follow these, so many: SmoothingResult::shared_middles.
std::string shared_middles_text(std::int64_t count);

/// Vertices that are held since what is around them is flat on purpose.
std::string held_layers_text(const LayersResult& layers);

/// These, where the mesh follows its boundary and carries them along.
std::string carried_layers_text(const LayersResult& layers);

/// Vertices that are smoothed though all around them is flat in one direction.
std::string left_layers_text(const LayersResult& layers);

/// Vertices that do not slide since lines touch without sharing vertices. `may_slide_together`: --slide-coincident is
/// there to be asked for. `may_join`: --merge is; else elements could name the same vertices.
std::string touching_lines_text(const SlidingResult& sliding, bool may_slide_together, bool may_join);

/// How far the new lines are from the old ones, in the unit of the points, or why nothing slides; empty where nothing
/// slid though it may.
std::string where_lines_are(const SlidingResult& sliding);

/// "396 of 396 vertices on 4 lines slid; lines are ..": what became of vertices that may slide. Never empty.
std::string sliding_text(const SlidingResult& sliding);

}  // namespace trismooth

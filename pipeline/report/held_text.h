// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// What is held and why, in one line without a line feed, for text reports:
///
///     804 of 3207: 140 boundary, 672 interface ('region'), 8 of them both
///
/// Reasons that hold no vertex are left out, but arrays that were obeyed are named, also where they hold none.
std::string held_text(const InputSummary& input);

/// What holds vertices and how many: "140 boundary, 672 interface, 8 of them both".
std::string held_counts_text(const HeldVertices& held);

/// Who found the neighbours of vertices: "found by OpenMesh halfedges".
std::string_view topology_text(Topology found_by);

/// The lines that the file has names for and how many vertices they hold: "12 'inlet', 40 'wall'"; empty without any.
std::string line_groups_text(const InputSummary& input);

/// Why a cell array gives regions, in words: "by its name".
std::string_view describe(RegionReason reason);

}  // namespace trismooth

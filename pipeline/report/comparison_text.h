// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// How a comparison went, in words without line feeds. There is one in the result where it is asked for.

/// "2284 of 3207 vertices, by 0.012 at most (vertex 17) and 0.0021 on average, ...": the vertices that moved.
std::string moved_text(const PipelineResult& result);

/// "30 boundary, 8 interface": what a smoothing would hold of those that moved. There are some.
std::string moved_held_text(const ComparisonResult& comparison);

/// "5210 better, 611 worse; 3 inverted or degenerate that were not": elements with a vertex that moved.
std::string changed_elements_text(const ComparisonResult& comparison);

/// "areas are what they were", "areas of regions changed by 0.12 % at most": of the regions, or of the whole mesh.
std::string areas_text(const PipelineResult& result);

}  // namespace trismooth

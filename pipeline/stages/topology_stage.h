#pragma once

#include <string>
#include <vector>

#include "trismooth/pipeline/held_vertices.h"

namespace trismooth {

struct RunState;

/// From cells to one-rings: triangles and their plane, regions, what holds vertices, orientation, neighbours. Throws
/// ReadError for what is no planar triangle mesh, std::invalid_argument for options that do not fit it.
void connect_mesh(RunState& run);

/// What the user should know of vertices that are held where triangles meet irregularly, one sentence each.
std::vector<std::string> notes_of_irregular_vertices(const ReasonCounts& counts);

}  // namespace trismooth

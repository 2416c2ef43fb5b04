// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

struct RunState;

/// From cells to one-rings: triangles and their plane, regions, what holds vertices, orientation, neighbours. Throws
/// ReadError for what is no planar triangle mesh, std::invalid_argument for options that do not fit it.
void connect_mesh(RunState& run);

}  // namespace trismooth

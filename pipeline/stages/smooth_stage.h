#pragma once

namespace trismooth {

struct RunState;

/// Smooths the mesh: the document's points are those of the result then. Throws Cancelled.
void smooth_mesh(RunState& run);

}  // namespace trismooth

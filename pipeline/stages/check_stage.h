#pragma once

namespace trismooth {

struct RunState;

/// Reports the quality of the mesh that was read, and of its regions.
void check_before(RunState& run);

/// Reports the quality after the smoothing.
void check_after(RunState& run);

}  // namespace trismooth

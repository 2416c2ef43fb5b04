// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

struct RunState;

/// Keeps in the result what pictures show of the mesh as it is now: the first time of the mesh that was read, then of
/// that one and of its result. Its quality is known. Complexity: linear.
void keep_picture(RunState& run);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

struct RunState;
struct SmoothingResult;

/// Smooths the mesh: the document's points are those of the result then, and so is what follows them. Nothing is where
/// it is cancelled.
SmoothingResult smooth_mesh(RunState& run);

}  // namespace trismooth

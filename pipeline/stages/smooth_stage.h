// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

struct MeshView;
struct RunState;
struct SmoothingResult;

/// Smooths the mesh: the document's points are those of the result then, and so is what follows them. Nothing is where
/// it is cancelled.
SmoothingResult smooth_mesh(RunState& run);

/// The areas of regions, `before` and as the mesh is now.
void compare_areas(RunState& run, const MeshView& before);

}  // namespace trismooth

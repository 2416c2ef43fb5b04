// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

struct PipelineOptions;
struct RunContext;
struct RunState;

/// Throws std::invalid_argument where meshes are to be compared, and something is asked for that there then is not.
void check_comparison(const PipelineOptions& options);

/// Reads the other mesh (PipelineOptions::compared), which has the points in the order of the run's document then, and
/// no cells. Throws ReadError where it cannot be read, or is another mesh: match_points().
MeshDocument read_compared(RunState& run);

/// Has the mesh of the run, which is connected, be where the other one is, and tells how they differ in the result.
/// Throws ReadError where the other mesh does not lie in a plane.
void compare_meshes(RunState& run, const MeshDocument& other);

/// What is to be said of the comparison when the other mesh has been checked.
void warn_of_comparison(RunContext& run);

}  // namespace trismooth

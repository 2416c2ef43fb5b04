// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime_api.h>

#include "trismooth/cuda/paper/mesh_layouts.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// Whether this build has the CDP version (TRISMOOTH_CDP).
bool built_with_cdp();

/// Queues the paper's version with CUDA dynamic parallelism ("CDP-" in its section 3.3.4). A parent of one block makes
/// one pass (Form A: all vertices; Form B: one colour) and launches two children in order: one updates the quality of
/// all triangles, one finds the minimum of each vertex; the next pass uses them. A parent cannot wait for its children
/// in today's CUDA, so the next pass is a tail launch of the parent by itself: it starts when the children are done. No
/// more than three launches are pending at any time. Each child and tail launch is checked; a failed one is stored in
/// the state's `error` and ends the sweeping. Arguments otherwise as those of launch_single_block().
/// Throws DeviceError in a build without.
template <class Mesh>
void launch_cdp(Method method, const Mesh& mesh, const LoopRules& rules, LoopState* state, SweepSums* sums,
                cudaStream_t stream);

}  // namespace trismooth::cuda

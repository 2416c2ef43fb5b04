// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime_api.h>

#include "trismooth/cuda/paper/mesh_layouts.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// Queues the paper's GPU version ("GPU-" in its section 3.3.4): one block, each thread of which takes every 1024th
/// vertex of a pass; a barrier after each pass; then each thread evaluates the elements of its vertices anew and stores
/// their minimum. After a colour of Form B the minima that the next colour will read are refreshed, which are all that
/// anybody reads before they are refreshed again. Sweeps until the rules say stop or rules.sweeps are done; sweep i of
/// the launch adds to sums[i], which are zero before. Stored minima are current before and after. `method`: smart or
/// laplacian, see SmoothingOptions::validate().
template <class Mesh>
void launch_single_block(Method method, const Mesh& mesh, const LoopRules& rules, LoopState* state, SweepSums* sums,
                         cudaStream_t stream);

}  // namespace trismooth::cuda

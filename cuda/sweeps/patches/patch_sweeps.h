// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/packing/patches.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/methods/methods.h"

namespace trismooth::cuda {

/// Positions of all vertices and, of the free ones, whether they moved in the last sweep: all that a group of sweeps
/// needs to know of the sweeps before it.
template <class T>
struct PatchBuffer {
  PointArray<T> points;
  std::uint8_t* moved;  ///< 1 before the first sweep
};

/// What these sweeps work on, in packed numbering: free vertices first. A group of sweeps goes
/// from one buffer to the other. Where fixed vertices are is the same in both.
template <class T>
struct PatchedMesh {
  PatchesView patches;
  std::int32_t colours;  ///< 0: Form A
  PatchBuffer<T> first;
  PatchBuffer<T> second;
};

/// Queues sweeps until the rules say stop or rules.sweeps are done: one launch of a block for each patch, with a
/// barrier of the grid after each group of sweeps. `shared_bytes`: patch_bytes(). Sweep i adds to sums[i], sweeps after
/// the last one too; these and the rules.sweeps words of `barriers` and of `found` are zero before. The rules measure
/// no shape.
template <class T>
void launch_patch_sweeps(const MethodInUse<T>& method, const PatchedMesh<T>& mesh, const LoopRules& rules,
                         std::size_t shared_bytes, std::int32_t free_count, LoopState* state, SweepSums* sums,
                         unsigned long long* barriers, unsigned long long* found, cudaStream_t stream);

}  // namespace trismooth::cuda

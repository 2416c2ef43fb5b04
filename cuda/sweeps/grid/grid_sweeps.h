// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/methods/methods.h"

namespace trismooth::cuda {

/// Positions of all vertices, and marks of the free ones.
template <class T>
struct GridBuffer {
  PointArray<T> points;
  std::uint32_t* marks;  ///< a bit for each free vertex, 0 before the first sweep: see mark()
};

/// What these sweeps work on, in packed numbering: free vertices first, batch after batch. Form B uses one
/// buffer for both. `Rings`: SlottedRingsView, or SlottedMixedRingsView where there are quadrilaterals.
template <class T, class Rings>
struct GridMesh {
  Rings rings;  ///< of the free vertices
  GridBuffer<T> first;
  GridBuffer<T> second;
};

/// Words for the barriers of a launch by these rules.
std::size_t barrier_words(const LoopRules& rules);

/// Queues `sweeps` sweeps that evaluate every vertex, a launch for each batch, and one more that marks. Each is only
/// made while the run goes on, less than rules.sweeps are done and the state says that all are to be evaluated: while
/// many vertices move that is cheaper than to mark and to list them. Sweep i of the run's launch adds to sums[i], which
/// are zero before. `batches`: as rules.batches, on the host. Returns how many kernels were launched.
template <class T, class Rings>
std::int32_t launch_sweeps_of_all(const MethodInUse<T>& method, const GridMesh<T, Rings>& mesh, const LoopRules& rules,
                                  std::span<const std::int32_t> batches, std::int32_t sweeps, LoopState* state,
                                  SweepSums* sums, cudaStream_t stream);

/// Queues sweeps that evaluate the marked vertices: one launch of the whole GPU, with a barrier after each batch, that
/// sweeps until the rules say stop or rules.sweeps are done, those of launch_sweeps_of_all() among them. The first of
/// them evaluates every vertex where the state says so still. The barrier_words() words of `barriers` are zero
/// before. `largest_batch`: vertices of the largest batch.
template <class T, class Rings>
void launch_sweeps_of_marked(const MethodInUse<T>& method, const GridMesh<T, Rings>& mesh, const LoopRules& rules,
                             std::int32_t largest_batch, LoopState* state, SweepSums* sums,
                             unsigned long long* barriers, cudaStream_t stream);

}  // namespace trismooth::cuda

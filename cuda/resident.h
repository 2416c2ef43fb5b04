#pragma once

#include <cstddef>
#include <cstdint>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/point_arrays.h"
#include "trismooth/cuda/rings.h"
#include "trismooth/cuda/sweep_state.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// Positions of all vertices, and which free ones are to be evaluated.
template <class T, Layout layout>
struct ResidentBuffer {
  PointArrays<T, layout> points;
  std::uint8_t* marked;  ///< a byte each: the closed neighbourhood changed since the last evaluation
};

/// What the resident execution works on, in packed numbering: free vertices first, batch after batch. Form B uses one
/// buffer for both.
template <class T, Layout layout>
struct ResidentMesh {
  RingsView rings;  ///< of the free vertices
  ResidentBuffer<T, layout> first;
  ResidentBuffer<T, layout> second;
};

/// Words for the barriers of a launch by these rules.
std::size_t resident_barriers(const LoopRules& rules);

/// Queues the resident execution: one launch of the whole GPU, with a barrier after each batch, that sweeps until the
/// rules say stop or rules.sweeps are done. Sweep i of the launch adds to sums[i]. These and the resident_barriers()
/// words of `barriers` are zero before. `largest_batch`: vertices of the largest batch.
template <class T, Layout layout>
void launch_resident(Method method, const ResidentMesh<T, layout>& mesh, const LoopRules& rules,
                     std::int32_t largest_batch, LoopState* state, SweepSums* sums, unsigned long long* barriers,
                     cudaStream_t stream);

/// Queues the measuring of the smallest quotient of the triangles with a free vertex into sums->min_quotient.
template <class T, Layout layout>
void launch_min_quotient(const RingsView& rings, const PointArrays<T, layout>& points, SweepSums* sums,
                         cudaStream_t stream);

}  // namespace trismooth::cuda

#pragma once

#include <cstdint>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/point_arrays.h"
#include "trismooth/cuda/rings.h"
#include "trismooth/cuda/sweep_state.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// What the resident execution works on, in packed numbering: free vertices first, batch after batch.
template <class T, Layout layout>
struct ResidentMesh {
  RingsView rings;                   ///< of the free vertices
  PointArrays<T, layout> points[2];  ///< all vertices; Form B uses the first alone
  /// Free vertices whose closed neighbourhood changed since their last evaluation: a byte each. Form B uses the first
  /// alone.
  std::uint8_t* marked[2];
};

/// Queues the resident execution: one launch of the whole GPU, with a barrier after each batch, that sweeps until the
/// rules say stop or rules.sweeps are done. Sweep i of the launch adds to sums[i], which are zero before.
template <class T, Layout layout>
void launch_resident(Method method, const ResidentMesh<T, layout>& mesh, const LoopRules& rules, LoopState* state,
                     SweepSums* sums, cudaStream_t stream);

/// Queues the measuring of the smallest quotient of the triangles with a free vertex into sums->min_quotient.
template <class T, Layout layout>
void launch_min_quotient(const RingsView& rings, const PointArrays<T, layout>& points, SweepSums* sums,
                         cudaStream_t stream);

}  // namespace trismooth::cuda

#pragma once

#include <cuda_runtime_api.h>

#include "trismooth/cuda/primitives/point_arrays.h"
#include "trismooth/cuda/sweeps/sweep_state.h"

namespace trismooth::cuda {

/// Queues the measuring of the smallest quotient of the triangles with a free vertex into sums->min_quotient. `Rings`:
/// RingsView or SlottedRingsView.
template <class T, Layout layout, class Rings>
void launch_smallest_quotient(const Rings& rings, const PointArrays<T, layout>& points, SweepSums* sums,
                              cudaStream_t stream);

}  // namespace trismooth::cuda

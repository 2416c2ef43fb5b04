// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime_api.h>

#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/sweeps/sweep_state.h"

namespace trismooth::cuda {

/// Queues the measuring of the smallest quotient of the triangles with a free vertex into sums->min_quotient. `Rings`:
/// RingsView, SlottedRingsView or SlottedMixedRingsView.
template <class T, class Rings>
void launch_smallest_quotient(const Rings& rings, const PointArray<T>& points, SweepSums* sums, cudaStream_t stream);

}  // namespace trismooth::cuda

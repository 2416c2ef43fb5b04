// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/cuda/update/ring_in_memory.cuh"
#include "trismooth/smoothing/methods/smart_laplacian.h"

namespace trismooth::cuda {

/// Joins the smallest quotient of the triangles with a free vertex to the sums of the sweep. All threads of the grid
/// call it.
template <class T, class Rings>
__device__ void measure_quotients(const Rings& rings, const PointArray<T>& points, SweepSums* sums) {
  double smallest = std::numeric_limits<double>::infinity();
  const std::int64_t stride = static_cast<std::int64_t>(gridDim.x) * blockDim.x;
  for (std::int64_t i = thread_index(); i < rings.size; i += stride) {
    const auto v = static_cast<std::int32_t>(i);
    const auto quotient = static_cast<double>(worst_quotient(points.load(v), ring_in_memory(points, rings, v)));
    smallest = quotient < smallest ? quotient : smallest;
  }
  join_min_quotient(smallest, sums);
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth::cuda {

/// The number of this thread in a one-dimensional grid. Grids cover at most 2^31 elements, so the last ones may lie
/// beyond: compare before narrowing.
__device__ inline std::int64_t thread_index() {
  return static_cast<std::int64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda/atomic>

namespace trismooth::cuda {

/// A barrier of all blocks of a grid, which are all on the device at the same time (a cooperative launch), that also
/// adds up what the blocks contribute. Each barrier of a launch has a word of its own, zero before: arrivals in its
/// lowest bits, the sum of the contributions above.
using BarrierWord = unsigned long long;

inline constexpr unsigned barrier_arrival_bits = 16;

/// All threads of the block call it, with the same `contribution`; what they have written is visible to all threads of
/// the grid after it. `before_waiting()` is called by the block's first thread between its arrival and its waiting.
/// Returns the sum of all contributions. `shared` is a word of the block's own.
template <class BeforeWaiting>
__device__ unsigned long long grid_barrier(BarrierWord* word, unsigned long long contribution,
                                           unsigned long long& shared, const BeforeWaiting& before_waiting) {
  constexpr unsigned long long arrivals = (1ULL << barrier_arrival_bits) - 1;
  __syncthreads();
  if (gridDim.x == 1) {
    if (threadIdx.x == 0) {
      before_waiting();
    }
    __syncthreads();
    return contribution;
  }
  if (threadIdx.x == 0) {
    const ::cuda::atomic_ref<BarrierWord, ::cuda::thread_scope_device> barrier(*word);
    barrier.fetch_add(1 + (contribution << barrier_arrival_bits), ::cuda::memory_order_release);
    before_waiting();
    unsigned long long seen = barrier.load(::cuda::memory_order_acquire);
    while ((seen & arrivals) < gridDim.x) {
      seen = barrier.load(::cuda::memory_order_acquire);
    }
    shared = seen >> barrier_arrival_bits;
  }
  __syncthreads();
  return shared;
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth::cuda {

/// The largest key of a warp. All threads of the warp call it.
__device__ inline unsigned long long largest_of_warp(unsigned long long key) {
  for (int distance = 16; distance > 0; distance /= 2) {
    const unsigned long long other = __shfl_xor_sync(0xffffffffU, key, distance);
    key = other > key ? other : key;
  }
  return key;
}

/// Raises `word`, in shared or in device memory, to the largest key of a warp. All threads of the warp call it.
__device__ inline void join_largest(unsigned long long* word, unsigned long long key) {
  key = largest_of_warp(key);
  if (threadIdx.x % 32 == 0) {
    atomicMax(word, key);
  }
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"

namespace trismooth::cuda {

namespace reduce_details {

/// Enough blocks to keep the memory busy, few enough for one block to join what they have found.
inline constexpr unsigned most_blocks = 1024;

/// Joins value(i) of all i below `count`: each block writes what it has found to results[its number].
template <class T, class Value, class Join>
__global__ void __launch_bounds__(block_size)
    join_in_blocks(std::uint32_t count, T neutral, Value value, Join join, T* results) {
  __shared__ T found[block_size];
  T own = neutral;
  for (std::int64_t i = thread_index(); i < count; i += static_cast<std::int64_t>(gridDim.x) * block_size) {
    own = join(own, value(static_cast<std::uint32_t>(i)));
  }
  found[threadIdx.x] = own;
  for (unsigned half = block_size / 2; half > 0; half /= 2) {
    __syncthreads();
    if (threadIdx.x < half) {
      found[threadIdx.x] = join(found[threadIdx.x], found[threadIdx.x + half]);
    }
  }
  if (threadIdx.x == 0) {
    results[blockIdx.x] = found[0];
  }
}

template <class T>
struct ResultOfBlock {
  const T* results;

  __device__ T operator()(std::uint32_t block) const { return results[block]; }
};

}  // namespace reduce_details

/// Joins value(i) of all i below `count` and waits for the result. `join` is associative and commutative, so that no
/// order shows, and a value joined with `neutral` stays as it is, which is the result of nothing.
template <class T, class Value, class Join>
T reduce(Context& context, std::uint32_t count, T neutral, const Value& value, const Join& join) {
  using namespace reduce_details;
  if (count == 0) {
    return neutral;
  }
  const unsigned blocks = std::min(blocks_for(count), most_blocks);
  DeviceBuffer<T> results(context, blocks);
  join_in_blocks<<<blocks, block_size, 0, context.stream()>>>(count, neutral, value, join, results.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  DeviceBuffer<T> result(context, 1);
  join_in_blocks<<<1, block_size, 0, context.stream()>>>(blocks, neutral, ResultOfBlock<T>{results.data()}, join,
                                                         result.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  return download(context, result.data());
}

}  // namespace trismooth::cuda

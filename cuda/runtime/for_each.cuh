// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"

namespace trismooth::cuda {

namespace for_each_details {

template <class Body>
__global__ void __launch_bounds__(block_size) run(std::uint32_t count, Body body) {
  const std::int64_t index = thread_index();
  if (index < count) {
    body(static_cast<std::uint32_t>(index));
  }
}

}  // namespace for_each_details

/// Queues body(i) for all i below `count`, one thread each, in any order.
template <class Body>
void for_each(const Context& context, std::uint32_t count, const Body& body) {
  if (count > 0) {
    for_each_details::run<<<blocks_for(count), block_size, 0, context.stream()>>>(count, body);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
}

/// Queues body(0), for one block of one thread.
template <class Body>
void for_one_thread(const Context& context, const Body& body) {
  for_each_details::run<<<1, 1, 0, context.stream()>>>(1, body);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

}  // namespace trismooth::cuda

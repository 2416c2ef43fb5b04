// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/memory_pool.h"

#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_memory.h"

namespace trismooth::cuda {

cudaMemPool_t memory_pool() {
  return current_pool();
}

void give_memory_back() {
  TRISMOOTH_CUDA_CHECK(cudaMemPoolTrimTo(current_pool(), 0));
}

}  // namespace trismooth::cuda

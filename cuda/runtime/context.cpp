// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/context.h"

#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_memory.h"

namespace trismooth::cuda {

Context::Context() : pool_(current_pool()) {
  const cudaError_t error = cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking);
  if (error == cudaErrorMemoryAllocation) {
    cudaGetLastError();
    throw too_little_memory(mebibytes(1) + " or more", device_memory());
  }
  TRISMOOTH_CUDA_CHECK(error);
}

Context::Context(cudaStream_t stream) : stream_(stream), owns_stream_(false), pool_(current_pool()) {}

Context::~Context() {
  if (owns_stream_) {
    cudaStreamDestroy(stream_);
  }
}

void Context::synchronize() const {
  TRISMOOTH_CUDA_CHECK(cudaStreamSynchronize(stream_));
}

void* Context::allocate(std::size_t bytes) {
  if (bytes == 0) {
    return nullptr;
  }
  void* memory = nullptr;
  const cudaError_t error = cudaMallocFromPoolAsync(&memory, bytes, pool_, stream_);
  if (error == cudaErrorMemoryAllocation) {
    cudaGetLastError();
    DeviceMemory available = device_memory();
    available.free += in_use_;
    throw too_little_memory(mebibytes(in_use_ + bytes) + " or more", available);
  }
  TRISMOOTH_CUDA_CHECK(error);
  in_use_ += bytes;
  peak_ = std::max(peak_, in_use_);
  return memory;
}

void Context::free(void* memory, std::size_t bytes) noexcept {
  if (memory != nullptr) {
    // An error here is one of an earlier call, which whoever synchronises next is told of.
    cudaFreeAsync(memory, stream_);
    in_use_ -= bytes;
  }
}

}  // namespace trismooth::cuda

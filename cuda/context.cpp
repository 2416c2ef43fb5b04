#include "trismooth/cuda/context.h"

#include <string>

#include "trismooth/cuda/error.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

namespace {

std::string mebibytes(std::size_t bytes) {
  return std::to_string((bytes + (std::size_t{1} << 20U) - 1) >> 20U) + " MiB";
}

}  // namespace

Context::Context() {
  TRISMOOTH_CUDA_CHECK(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
}

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
  const cudaError_t error = cudaMallocAsync(&memory, bytes, stream_);
  if (error == cudaErrorMemoryAllocation) {
    cudaGetLastError();
    std::size_t free_bytes = 0;
    std::size_t total_bytes = 0;
    TRISMOOTH_CUDA_CHECK(cudaMemGetInfo(&free_bytes, &total_bytes));
    throw DeviceError("CUDA: cudaErrorMemoryAllocation: this mesh needs " + mebibytes(in_use_ + bytes) +
                      " of device memory or more, and the device has " + mebibytes(free_bytes + in_use_) + " free of " +
                      mebibytes(total_bytes) + "; use a device with more memory, or '--backend cpu'");
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

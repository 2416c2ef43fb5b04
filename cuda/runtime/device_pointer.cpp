// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/device_pointer.h"

#include <cstdint>
#include <stdexcept>
#include <string>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

namespace {

/// As on machines whose GPU shares the page tables of the processor.
bool reads_any_memory_of_the_host() {
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  int reads = 0;
  TRISMOOTH_CUDA_CHECK(cudaDeviceGetAttribute(&reads, cudaDevAttrPageableMemoryAccess, device));
  return reads != 0;
}

}  // namespace

void require_aligned(const void* array, std::size_t count, std::size_t alignment, std::string_view name) {
  if (count == 0) {
    return;
  }
  if (array == nullptr) {
    throw std::invalid_argument(std::string(name) + " is a null pointer");
  }
  if (reinterpret_cast<std::uintptr_t>(array) % alignment != 0) {
    throw std::invalid_argument(std::string(name) + " is not aligned to " + std::to_string(alignment) +
                                " bytes, as it must be on a device");
  }
}

void require_on_device(const void* array, std::size_t count, std::string_view name) {
  if (count == 0) {
    return;
  }
  cudaPointerAttributes attributes{};
  TRISMOOTH_CUDA_CHECK(cudaPointerGetAttributes(&attributes, array));
  if (attributes.type == cudaMemoryTypeUnregistered && !reads_any_memory_of_the_host()) {
    throw std::invalid_argument(std::string(name) + " points to memory of the host, not of a device");
  }
}

}  // namespace trismooth::cuda

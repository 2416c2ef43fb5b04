// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/device_properties.h"

#include <cuda_runtime_api.h>

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

namespace {

int attribute(cudaDeviceAttr name) {
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  int value = 0;
  TRISMOOTH_CUDA_CHECK(cudaDeviceGetAttribute(&value, name, device));
  return value;
}

}  // namespace

int multiprocessor_count() {
  return attribute(cudaDevAttrMultiProcessorCount);
}

std::size_t most_shared_bytes() {
  return static_cast<std::size_t>(attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin));
}

}  // namespace trismooth::cuda

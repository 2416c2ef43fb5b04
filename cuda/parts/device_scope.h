#pragma once

#include <cuda_runtime_api.h>

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

/// Makes a device current as long as it lives, for the thread that made it.
class DeviceScope {
 public:
  explicit DeviceScope(int device) {
    TRISMOOTH_CUDA_CHECK(cudaGetDevice(&before_));
    TRISMOOTH_CUDA_CHECK(cudaSetDevice(device));
  }
  DeviceScope(const DeviceScope&) = delete;
  DeviceScope& operator=(const DeviceScope&) = delete;
  ~DeviceScope() { cudaSetDevice(before_); }

 private:
  int before_ = 0;
};

}  // namespace trismooth::cuda

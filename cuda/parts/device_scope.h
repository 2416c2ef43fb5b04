// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

/// Makes a device current as long as it lives, for the thread that made it; none: leaves whichever is.
class DeviceScope {
 public:
  explicit DeviceScope(std::optional<int> device) {
    if (device) {
      TRISMOOTH_CUDA_CHECK(cudaGetDevice(&before_.emplace()));
      TRISMOOTH_CUDA_CHECK(cudaSetDevice(*device));
    }
  }
  DeviceScope(const DeviceScope&) = delete;
  DeviceScope& operator=(const DeviceScope&) = delete;
  ~DeviceScope() {
    if (before_) {
      cudaSetDevice(*before_);
    }
  }

 private:
  std::optional<int> before_;
};

/// For an object that has memory of a device: a member before all others, which go after begin() has made that device
/// current, and before it makes current again what was so.
class DeviceAtEnd {
 public:
  DeviceAtEnd() = default;
  DeviceAtEnd(const DeviceAtEnd&) = delete;
  DeviceAtEnd& operator=(const DeviceAtEnd&) = delete;
  ~DeviceAtEnd() { cudaSetDevice(before_); }

  /// To be called by the object's destructor. Errors are those of earlier calls, which have been told.
  void begin(int device) {
    cudaGetDevice(&before_);
    cudaSetDevice(device);
  }

 private:
  int before_ = 0;
};

}  // namespace trismooth::cuda

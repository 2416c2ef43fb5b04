// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include <cuda_runtime_api.h>

#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

/// The pool of the current device, as memory_pool() says.
cudaMemPool_t current_pool();

/// Bytes that the current device's pool keeps without using them.
std::size_t kept_memory();

/// Bytes of the current device's memory.
struct DeviceMemory {
  std::size_t free = 0;  ///< what the pool keeps without using it is free for us as well
  std::size_t total = 0;
};
DeviceMemory device_memory();

/// What to throw where a mesh needs `needed` ("about 12 MiB") and there is no more than this.
DeviceError too_little_memory(const std::string& needed, const DeviceMemory& memory);

/// "12 MiB", rounded up.
std::string mebibytes(std::size_t bytes);

}  // namespace trismooth::cuda

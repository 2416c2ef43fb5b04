#pragma once

#include <cstddef>
#include <string>

#include <cuda_runtime_api.h>

#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

/// Where the memory of all smoothers on the current device comes from: a pool of our own, made at its first use and
/// kept for as long as the process. CUDA's default pool gives everything back whenever somebody waits for the device,
/// and mapping it anew takes longer than a small mesh; its settings belong to the program that we are part of. This
/// pool keeps what is freed, up to a sixteenth of the device's memory in all; see give_memory_back().
cudaMemPool_t memory_pool();

/// Returns what the current device's pool keeps without using it to the device, for whoever else needs it. What
/// smoothers and plans use stays. Throws DeviceError.
void give_memory_back();

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

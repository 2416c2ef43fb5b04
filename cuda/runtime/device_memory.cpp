// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/device_memory.h"

#include <cstdint>
#include <map>
#include <mutex>

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

namespace {

/// The pool keeps freed memory, at most the device's divided by this: enough for a mesh of millions of vertices to be
/// smoothed again and again, little enough for others on the device.
constexpr std::size_t kept_part = 16;

cudaMemPool_t make_pool(int device) {
  cudaMemPoolProps properties{};
  properties.allocType = cudaMemAllocationTypePinned;
  properties.handleTypes = cudaMemHandleTypeNone;
  properties.location.type = cudaMemLocationTypeDevice;
  properties.location.id = device;
  cudaMemPool_t pool = nullptr;
  TRISMOOTH_CUDA_CHECK(cudaMemPoolCreate(&pool, &properties));
  std::size_t free = 0;
  std::size_t total = 0;
  TRISMOOTH_CUDA_CHECK(cudaMemGetInfo(&free, &total));
  std::uint64_t kept = total / kept_part;
  TRISMOOTH_CUDA_CHECK(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &kept));
  return pool;
}

std::uint64_t attribute(cudaMemPool_t pool, cudaMemPoolAttr which) {
  std::uint64_t value = 0;
  TRISMOOTH_CUDA_CHECK(cudaMemPoolGetAttribute(pool, which, &value));
  return value;
}

}  // namespace

cudaMemPool_t current_pool() {
  static std::mutex mutex;
  static std::map<int, cudaMemPool_t> pools;  // by device; never destroyed: CUDA may end before we do
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  const std::lock_guard lock(mutex);
  auto found = pools.find(device);
  if (found == pools.end()) {
    found = pools.emplace(device, make_pool(device)).first;
  }
  return found->second;
}

std::size_t kept_memory() {
  cudaMemPool_t pool = current_pool();
  const std::uint64_t used = attribute(pool, cudaMemPoolAttrUsedMemCurrent);
  const std::uint64_t reserved = attribute(pool, cudaMemPoolAttrReservedMemCurrent);
  return reserved > used ? reserved - used : 0;
}

DeviceMemory device_memory() {
  DeviceMemory memory;
  TRISMOOTH_CUDA_CHECK(cudaMemGetInfo(&memory.free, &memory.total));
  memory.free += kept_memory();
  return memory;
}

DeviceError too_little_memory(const std::string& needed, const DeviceMemory& memory) {
  const std::string message = "CUDA: cudaErrorMemoryAllocation: this mesh needs " + needed +
                              " of device memory, and the device has " + mebibytes(memory.free) + " free of " +
                              mebibytes(memory.total) + "; use a device with more memory, or '--backend cpu'";
  return DeviceError{message};
}

std::string mebibytes(std::size_t bytes) {
  return std::to_string((bytes + (std::size_t{1} << 20U) - 1) >> 20U) + " MiB";
}

}  // namespace trismooth::cuda

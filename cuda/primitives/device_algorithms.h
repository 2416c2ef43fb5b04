#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// Replaces each value by the sum of all up to it, itself included. Queued; in place.
void sum_up(Context& context, std::uint32_t* values, std::int64_t count);

/// Replaces each value by the sum of all before it. Queued; in place. So n counts and one more value become n + 1
/// offsets.
void sum_before(Context& context, std::uint32_t* values, std::int64_t count);

/// Sorts keys by their lowest `key_bits` bits, and the values (std::uint32_t or std::int32_t) with them. Queued. Takes
/// as much memory again as both.
template <class Value>
void sort_by_key(Context& context, DeviceBuffer<std::uint64_t>& keys, DeviceBuffer<Value>& values, int key_bits);

/// Waits for the device and returns one of its values.
template <class T>
T download(const Context& context, const T* value) {
  T result;
  TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(&result, value, sizeof(T), cudaMemcpyDeviceToHost, context.stream()));
  context.synchronize();
  return result;
}

/// Waits for the device and returns `count` of its values.
template <class T>
std::vector<T> download(const Context& context, const T* values, std::size_t count) {
  std::vector<T> copy(count);
  if (count > 0) {
    TRISMOOTH_CUDA_CHECK(
        cudaMemcpyAsync(copy.data(), values, count * sizeof(T), cudaMemcpyDeviceToHost, context.stream()));
  }
  context.synchronize();
  return copy;
}

}  // namespace trismooth::cuda

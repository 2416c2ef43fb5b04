// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// Replaces each value by the sum of all up to it, itself included. Queued; in place.
void sum_up(Context& context, std::uint32_t* values, std::int64_t count);

/// Replaces each value by the sum of all before it. Queued; in place. So n counts and one more value become n + 1
/// offsets.
void sum_before(Context& context, std::uint32_t* values, std::int64_t count);

/// Whether the sorted ones are in the other arrays.
struct SortedIn {
  bool other_keys;
  bool other_values;
};

/// Sorts `count` keys by their lowest `key_bits` bits, and the words beside them. Queued. There are two arrays of each;
/// what was in either is lost.
SortedIn sort_words(Context& context, std::int64_t count, std::uint64_t* keys, std::uint64_t* other_keys,
                    std::uint32_t* values, std::uint32_t* other_values, int key_bits);

/// Sorts keys by their lowest `key_bits` bits, and the values (std::uint32_t or std::int32_t) with them. Queued. Takes
/// as much memory again as both.
template <class Value>
void sort_by_key(Context& context, DeviceBuffer<std::uint64_t>& keys, DeviceBuffer<Value>& values, int key_bits) {
  static_assert(std::is_same_v<Value, std::uint32_t> || std::is_same_v<Value, std::int32_t>);
  const auto count = static_cast<std::int64_t>(keys.size());
  if (count == 0) {
    return;
  }
  DeviceBuffer<std::uint64_t> other_keys(context, keys.size());
  DeviceBuffer<Value> other_values(context, values.size());
  const SortedIn sorted =
      sort_words(context, count, keys.data(), other_keys.data(), reinterpret_cast<std::uint32_t*>(values.data()),
                 reinterpret_cast<std::uint32_t*>(other_values.data()), key_bits);
  if (sorted.other_keys) {
    std::swap(keys, other_keys);
  }
  if (sorted.other_values) {
    std::swap(values, other_values);
  }
}

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

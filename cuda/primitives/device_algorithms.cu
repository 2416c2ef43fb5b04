// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

#include "trismooth/cuda/primitives/device_algorithms.h"

namespace trismooth::cuda {

namespace {

/// Calls a function of CUB twice, as they want it: for the size of its scratch memory, and to queue the work.
template <class Call>
void with_scratch(Context& context, const Call& call) {
  std::size_t bytes = 0;
  TRISMOOTH_CUDA_CHECK(call(nullptr, bytes));
  bytes = std::max<std::size_t>(bytes, 1);  // no scratch memory would ask for the size again
  DeviceBuffer<std::byte> scratch(context, bytes);
  TRISMOOTH_CUDA_CHECK(call(scratch.data(), bytes));
}

}  // namespace

void sum_up(Context& context, std::uint32_t* values, std::int64_t count) {
  if (count > 0) {
    with_scratch(context, [&](void* scratch, std::size_t& bytes) {
      return cub::DeviceScan::InclusiveSum(scratch, bytes, values, values, count, context.stream());
    });
  }
}

void sum_before(Context& context, std::uint32_t* values, std::int64_t count) {
  if (count > 0) {
    with_scratch(context, [&](void* scratch, std::size_t& bytes) {
      return cub::DeviceScan::ExclusiveSum(scratch, bytes, values, values, count, context.stream());
    });
  }
}

SortedIn sort_words(Context& context, std::int64_t count, std::uint64_t* keys, std::uint64_t* other_keys,
                    std::uint32_t* values, std::uint32_t* other_values, int key_bits) {
  cub::DoubleBuffer<std::uint64_t> both_keys(keys, other_keys);
  cub::DoubleBuffer<std::uint32_t> both_values(values, other_values);
  with_scratch(context, [&](void* scratch, std::size_t& bytes) {
    return cub::DeviceRadixSort::SortPairs(scratch, bytes, both_keys, both_values, count, 0, key_bits,
                                           context.stream());
  });
  return {both_keys.Current() != keys, both_values.Current() != values};
}

}  // namespace trismooth::cuda

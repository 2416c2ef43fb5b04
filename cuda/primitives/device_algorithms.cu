#include <algorithm>
#include <cstddef>
#include <utility>

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

template <class Value>
void sort_by_key(Context& context, DeviceBuffer<std::uint64_t>& keys, DeviceBuffer<Value>& values, int key_bits) {
  const auto count = static_cast<std::int64_t>(keys.size());
  if (count == 0) {
    return;
  }
  DeviceBuffer<std::uint64_t> other_keys(context, keys.size());
  DeviceBuffer<Value> other_values(context, values.size());
  cub::DoubleBuffer<std::uint64_t> both_keys(keys.data(), other_keys.data());
  cub::DoubleBuffer<Value> both_values(values.data(), other_values.data());
  with_scratch(context, [&](void* scratch, std::size_t& bytes) {
    return cub::DeviceRadixSort::SortPairs(scratch, bytes, both_keys, both_values, count, 0, key_bits,
                                           context.stream());
  });
  if (both_keys.Current() != keys.data()) {
    std::swap(keys, other_keys);
  }
  if (both_values.Current() != values.data()) {
    std::swap(values, other_values);
  }
}

template void sort_by_key(Context&, DeviceBuffer<std::uint64_t>&, DeviceBuffer<std::uint32_t>&, int);
template void sort_by_key(Context&, DeviceBuffer<std::uint64_t>&, DeviceBuffer<std::int32_t>&, int);

}  // namespace trismooth::cuda

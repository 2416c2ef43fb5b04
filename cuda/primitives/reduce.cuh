#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <cub/device/device_reduce.cuh>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>

#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// Joins value(i) of all i below `count`, beginning with `start`, and waits for the result. `join` is associative and
/// commutative, so that no order shows.
template <class T, class Value, class Join>
T reduce(Context& context, std::uint32_t count, T start, const Value& value, const Join& join) {
  if (count == 0) {
    return start;
  }
  const auto values = thrust::make_transform_iterator(thrust::counting_iterator<std::uint32_t>(0), value);
  DeviceBuffer<T> result(context, 1);
  std::size_t bytes = 0;
  TRISMOOTH_CUDA_CHECK(
      cub::DeviceReduce::Reduce(nullptr, bytes, values, result.data(), count, join, start, context.stream()));
  DeviceBuffer<std::byte> scratch(context, std::max<std::size_t>(bytes, 1));
  TRISMOOTH_CUDA_CHECK(
      cub::DeviceReduce::Reduce(scratch.data(), bytes, values, result.data(), count, join, start, context.stream()));
  return download(context, result.data());
}

}  // namespace trismooth::cuda

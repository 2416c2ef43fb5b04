// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/primitives/gather_bytes.h"
#include "trismooth/cuda/runtime/for_each.cuh"

namespace trismooth::cuda {

namespace {

struct GatherBytes {
  const std::uint8_t* values;
  const std::int32_t* numbers;
  std::uint8_t* gathered;

  __device__ void operator()(std::uint32_t i) const { gathered[i] = values[numbers[i]]; }
};

}  // namespace

std::vector<std::uint8_t> gather_bytes(Context& context, const std::uint8_t* values,
                                       const DeviceBuffer<std::int32_t>& numbers) {
  DeviceBuffer<std::uint8_t> gathered(context, numbers.size());
  for_each(context, static_cast<std::uint32_t>(numbers.size()), GatherBytes{values, numbers.data(), gathered.data()});
  std::vector<std::uint8_t> found(numbers.size());
  gathered.download(found);
  return found;
}

}  // namespace trismooth::cuda

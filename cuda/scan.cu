#include <cub/device/device_scan.cuh>

#include "trismooth/cuda/scan.h"

namespace trismooth::cuda {

void exclusive_scan(Context& context, DeviceBuffer<std::uint32_t>& counts) {
  std::size_t bytes = 0;
  const auto run = [&](void* memory) {
    TRISMOOTH_CUDA_CHECK(cub::DeviceScan::ExclusiveSum(memory, bytes, counts.data(), counts.data(),
                                                       static_cast<std::int64_t>(counts.size()), context.stream()));
  };
  run(nullptr);
  DeviceBuffer<std::uint8_t> memory(context, bytes);
  run(memory.data());
}

}  // namespace trismooth::cuda

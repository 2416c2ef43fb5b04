#pragma once

#include <cstdint>

#include "trismooth/cuda/device_buffer.h"

namespace trismooth::cuda {

/// Replaces counts by offsets: element i becomes the sum of those before it. So an array of n counts and one more
/// element becomes n + 1 offsets.
void exclusive_scan(Context& context, DeviceBuffer<std::uint32_t>& counts);

}  // namespace trismooth::cuda

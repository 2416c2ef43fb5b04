// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// values[numbers[i]] of each number; waits for the device.
std::vector<std::uint8_t> gather_bytes(Context& context, const std::uint8_t* values,
                                       const DeviceBuffer<std::int32_t>& numbers);

}  // namespace trismooth::cuda

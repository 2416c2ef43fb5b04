// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// Which triangles are connected through edges with exactly two triangles, and listed alike.
struct Components {
  DeviceBuffer<std::uint32_t>
      words;               ///< per triangle: (its component << 1) | 1 where it is listed against the lowest one
  std::int32_t count = 0;  ///< components are numbered in the order of their lowest triangles
  std::int64_t reoriented_triangles = 0;  ///< listed against the majority of their component
};

/// Numbers the trees of a finished ParityForest over all triangles, whose memory it takes over. Waits for the device.
Components number_components(Context& context, DeviceBuffer<std::uint32_t> forest_words);

}  // namespace trismooth::cuda

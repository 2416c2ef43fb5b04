// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// One-rings in device memory, for kernels. Vertices from `size` on have no ring: they are fixed.
struct RingsView {
  std::int32_t size;               ///< vertices with an entry in `offsets`
  const std::uint32_t* offsets;    ///< vertex v has neighbours[offsets[v] .. offsets[v + 1]); maybe none
  const std::int32_t* neighbours;  ///< in ring order

  TRISMOOTH_HOST_DEVICE std::int32_t ring_size(std::int32_t vertex) const {
    return static_cast<std::int32_t>(offsets[vertex + 1] - offsets[vertex]);
  }
  TRISMOOTH_HOST_DEVICE const std::int32_t* ring(std::int32_t vertex) const { return neighbours + offsets[vertex]; }
};

/// Owns them. 32-bit offsets reach for every mesh: three corners of at most 715827882 triangles.
struct DeviceRings {
  DeviceBuffer<std::uint32_t> offsets;
  DeviceBuffer<std::int32_t> neighbours;

  std::int32_t size() const { return offsets.size() == 0 ? 0 : static_cast<std::int32_t>(offsets.size()) - 1; }
  RingsView view() const { return {size(), offsets.data(), neighbours.data()}; }
};

}  // namespace trismooth::cuda

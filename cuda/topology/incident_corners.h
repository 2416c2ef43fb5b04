// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// The corners at each vertex, in no order. A corner says both what the paper records: the incident element, and with
/// it two neighbours.
struct CornersView {
  std::int32_t vertex_count;
  const std::uint32_t* offsets;  ///< vertex v has corners[offsets[v] .. offsets[v + 1])
  const std::int32_t* corners;   ///< 3 t + i for corner i of triangle t

  TRISMOOTH_HOST_DEVICE std::uint32_t degree(std::uint32_t vertex) const {
    return offsets[vertex + 1] - offsets[vertex];
  }
  TRISMOOTH_HOST_DEVICE const std::int32_t* at(std::uint32_t vertex) const { return corners + offsets[vertex]; }
};

/// Owns them.
struct IncidentCorners {
  DeviceBuffer<std::uint32_t> offsets;  ///< vertex_count + 2: the last one is used only while they are filled
  DeviceBuffer<std::int32_t> corners;

  CornersView view() const { return {static_cast<std::int32_t>(offsets.size() - 2), offsets.data(), corners.data()}; }
};

}  // namespace trismooth::cuda

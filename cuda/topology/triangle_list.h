// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth::cuda {

/// A view of the triangles for kernels. Corner 3 t + i is corner i of triangle t.
struct TriangleList {
  const std::int32_t* vertices;  ///< of every corner
  std::int32_t count;            ///< triangles, at most 2^31 / 3

  TRISMOOTH_HOST_DEVICE Triangle operator[](std::uint32_t triangle) const {
    const std::int32_t* const corner = vertices + 3 * static_cast<std::size_t>(triangle);
    return {corner[0], corner[1], corner[2]};
  }
  /// The vertex after the corner's own in its triangle as listed (side 0), or before it (side 1).
  TRISMOOTH_HOST_DEVICE std::int32_t neighbour(std::int32_t corner, int side) const {
    const std::int32_t i = corner % 3;
    return vertices[corner - i + (i + 1 + side) % 3];
  }
};

}  // namespace trismooth::cuda

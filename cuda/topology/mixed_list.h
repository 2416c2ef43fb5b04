// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth::cuda {

/// A view of triangles and quadrilaterals for kernels.
struct MixedList {
  const std::int32_t* vertices;  ///< four of every element, no_corner in the last place of a triangle
  std::int32_t count;            ///< elements, at most 2^31 / 4

  TRISMOOTH_HOST_DEVICE MixedElement operator[](std::uint32_t element) const {
    const std::int32_t* const corner = vertices + 4 * static_cast<std::size_t>(element);
    return {corner[0], corner[1], corner[2], corner[3]};
  }
};

}  // namespace trismooth::cuda

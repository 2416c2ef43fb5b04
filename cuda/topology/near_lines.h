// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth::cuda {

/// The triangles with a vertex that nothing but lines holds, and the vertices that something else does. `fixed`: the
/// bits of namespace hold of each vertex; `regions`: null where there are none. Waits for the device.
NearLines near_lines(Context& context, const TriangleList& triangles, std::int32_t vertex_count,
                     const std::uint8_t* fixed, const std::int32_t* regions);

}  // namespace trismooth::cuda

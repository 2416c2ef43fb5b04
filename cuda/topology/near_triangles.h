#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth::cuda {

/// The triangles with a vertex that nothing but lines holds, in any order. `fixed`: the bits of namespace
/// hold of each vertex; `regions`: null where there are none. Waits for the device.
std::vector<NearTriangle> near_triangles(Context& context, const TriangleList& triangles, const std::uint8_t* fixed,
                                         const std::int32_t* regions);

}  // namespace trismooth::cuda

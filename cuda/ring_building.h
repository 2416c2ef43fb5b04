#pragma once

#include <cstdint>

#include "trismooth/cuda/context.h"
#include "trismooth/cuda/incident_corners.h"
#include "trismooth/cuda/large_fans.h"
#include "trismooth/cuda/rings.h"
#include "trismooth/cuda/triangle_list.h"

namespace trismooth::cuda {

/// The one-rings of the vertices whose `fixed` byte is 0: counter-clockwise, from the smallest neighbour on. Waits for
/// the device to learn their size.
DeviceRings build_rings(Context& context, const TriangleList& triangles, const CornersView& corners,
                        const LargeFans& large_fans, const std::uint8_t* fixed, const std::uint8_t* reversed);

}  // namespace trismooth::cuda

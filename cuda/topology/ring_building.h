// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/incident_corners.h"
#include "trismooth/cuda/topology/large_fans.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// The one-rings of the vertices whose `fixed` byte is 0: counter-clockwise, from the smallest neighbour on. Waits for
/// the device to learn their size.
DeviceRings build_rings(Context& context, const TriangleList& triangles, const CornersView& corners,
                        const LargeFans& large_fans, const std::uint8_t* fixed, const std::uint8_t* reversed);

}  // namespace trismooth::cuda

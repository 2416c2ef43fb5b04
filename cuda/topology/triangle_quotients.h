#pragma once

#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// trismooth::FixedTriangles::smallest_quotient(). Waits for the device.
double smallest_fixed_quotient(Context& context, const TriangleList& triangles, const Point2<double>* points,
                               const std::uint8_t* reversed, const std::uint8_t* fixed);

}  // namespace trismooth::cuda

#pragma once

#include <cstdint>

#include "trismooth/cuda/context.h"
#include "trismooth/cuda/triangle_list.h"
#include "trismooth/quality/point2.h"

namespace trismooth::cuda {

/// trismooth::smallest_fixed_quotient(). Waits for the device.
double smallest_fixed_quotient(Context& context, const TriangleList& triangles, const Point2<double>* points,
                               const std::uint8_t* reversed, const std::uint8_t* fixed);

}  // namespace trismooth::cuda

#pragma once

#include <cstdint>

#include "trismooth/cuda/context.h"
#include "trismooth/cuda/triangle_list.h"
#include "trismooth/quality/point2.h"

namespace trismooth::cuda {

/// Evaluates the shape quotient of every triangle as it is listed, one thread each, as the paper's initiating procedure
/// does. `points` are in the local frame. Queued.
void evaluate_triangles(const Context& context, const TriangleList& triangles, const Point2<double>* points,
                        double* quotients);

/// trismooth::smallest_fixed_quotient(). Waits for the device.
double smallest_fixed_quotient(Context& context, const TriangleList& triangles, const Point2<double>* points,
                               const std::uint8_t* reversed, const std::uint8_t* fixed);

}  // namespace trismooth::cuda

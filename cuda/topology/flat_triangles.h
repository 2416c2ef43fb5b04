#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/smoothing/layers/flat_triangle.h"

namespace trismooth::cuda {

/// trismooth::flat_candidates() of a mesh on the device, in any order; also where they are few.
/// Memory meanwhile: 4 bytes a vertex and 1 a triangle. Waits for the device.
std::vector<FlatTriangle> flat_candidates(Context& context, const TriangleList& triangles, std::int32_t vertex_count,
                                          const Point2<double>* points, const std::uint8_t* reversed, int choices);

}  // namespace trismooth::cuda

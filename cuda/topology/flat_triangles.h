// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/smoothing/layers/flat_triangle.h"

namespace trismooth::cuda {

/// trismooth::LayerCandidates of a mesh on the device.
class LayerCandidates {
 public:
  /// All of it outlives this. Memory: 1 byte a triangle, and 12 a vertex meanwhile. Queued.
  LayerCandidates(Context& context, const TriangleList& triangles, std::int32_t vertex_count,
                  const Point2<double>* points, const std::uint8_t* reversed);

  /// Those left after so many choices, in any order, also where they are few. Waits for the device.
  std::vector<FlatTriangle> after(int choices) const;

 private:
  Context* context_;
  TriangleList triangles_;
  const Point2<double>* points_;
  const std::uint8_t* reversed_;
  DeviceBuffer<std::uint8_t> levels_;
};

}  // namespace trismooth::cuda

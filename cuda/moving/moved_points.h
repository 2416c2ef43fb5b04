// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/smoothing/moving/relative_shape.h"

/// Steps of a mesh that follows its boundary, over all of its points or triangles: what HostFollower does, in device
/// memory, to the same bits.
namespace trismooth::cuda {

/// local[v] = rescaled(frame.enter(stored[v]), power). Queued.
void enter_rescaled(const Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame& frame,
                    int power, Point2<double>* local);

/// Where all vertices are stored: held ones where `stored` has them, free ones (`held` is 0) where `from` has them, to
/// be rounded, but those that are carried, which are at `places`, in `frame`. Queued.
void leave_carried(const Context& context, const DeviceBuffer<std::int32_t>& carried, const std::uint8_t* held,
                   const Point2<double>* stored, const Point2<double>* from, const Point2<double>* places,
                   const LocalFrame& frame, Storage storage, DeviceBuffer<Point2<double>>& now);

/// The points of some vertices. Waits.
std::vector<Point2<double>> points_of_vertices(Context& context, const DeviceBuffer<std::int32_t>& vertices,
                                               const Point2<double>* points);

/// overlapping_vertices(). Waits.
std::vector<std::int32_t> overlapping_vertices(Context& context, const TriangleList& triangles,
                                               const std::uint8_t* reversed, const std::uint8_t* held,
                                               const Point2<double>* local, std::int32_t vertex_count);

/// relative_shapes() of all triangles, and the sum of their shapes. Waits.
RelativeShapes relative_shapes(Context& context, const TriangleList& triangles, const std::uint8_t* reversed,
                               const std::uint8_t* held, const Point2<double>* rest, const Point2<double>* now,
                               double& sum);

/// The largest length_of_move(). Waits.
double largest_move(Context& context, const Point2<double>* before, const Point2<double>* now, std::int32_t count,
                    int exponent);

}  // namespace trismooth::cuda

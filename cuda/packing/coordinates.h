// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/packing/vertex_order.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// local[v] = frame->enter(stored[v]). The frame is on the device; points are aligned to 16 bytes.
void enter_frame(Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame* frame,
                 Point2<double>* local);

/// Queues the way to the working positions: before[v] = frame->enter(stored[input_index[v]]), and the same in working
/// precision into both `first` and `second` (which may be the same). The frame is on the device.
template <class T>
void enter_frame_packed(Context& context, const Point2<double>* stored, const VertexOrder& order,
                        const LocalFrame* frame, Point2<double>* before, const PointArray<T>& first,
                        const PointArray<T>& second);

/// Coordinates of float as double, and back (exact where they were rounded to float32 before). Points are aligned to
/// their size.
void widen_coordinates(Context& context, const float* xy, std::int32_t count, Point2<double>* points);
void narrow_coordinates(Context& context, const Point2<double>* points, std::int32_t count, float* xy);

}  // namespace trismooth::cuda

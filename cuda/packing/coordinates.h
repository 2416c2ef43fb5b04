#pragma once

#include <cstdint>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// local[v] = frame->enter(stored[v]). The frame is on the device; points are aligned to 16 bytes.
void enter_frame(Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame* frame,
                 Point2<double>* local);

/// Coordinates of float as double, and back (exact where they were rounded to float32 before). Points are aligned to
/// their size.
void widen(Context& context, const float* xy, std::int32_t count, Point2<double>* points);
void narrow(Context& context, const Point2<double>* points, std::int32_t count, float* xy);

}  // namespace trismooth::cuda

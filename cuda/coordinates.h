#pragma once

#include <cstdint>

#include "trismooth/cuda/device_buffer.h"
#include "trismooth/quality/local_frame.h"
#include "trismooth/quality/point2.h"

namespace trismooth::cuda {

/// The smallest number of a point with a coordinate that is not finite, or -1. Waits for the answer.
std::int32_t first_not_finite(Context& context, const Point2<double>* points, std::int32_t count);

/// local[v] = frame.enter(stored[v]).
void enter_frame(Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame& frame,
                 Point2<double>* local);

/// Coordinates of float as double, and back (exact where they were rounded to float32 before).
void widen(Context& context, const float* xy, std::int32_t count, Point2<double>* points);
void narrow(Context& context, const Point2<double>* points, std::int32_t count, float* xy);

}  // namespace trismooth::cuda

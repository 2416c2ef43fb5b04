#pragma once

#include <cstdint>

#include "trismooth/cuda/device_buffer.h"
#include "trismooth/quality/point2.h"

namespace trismooth::cuda {

/// The smallest and the largest coordinates of some points.
struct BoundingBox {
  Point2<double> low;
  Point2<double> high;
};

/// The bounding box of `count` finite points (at least one) on the device. Waits for the answer.
BoundingBox bounding_box(Context& context, const Point2<double>* points, std::int64_t count);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"

namespace trismooth::cuda {

/// rounded_to(), on a device.
inline __device__ Point2<double> rounded_point(Point2<double> point, Storage storage) {
  return storage == Storage::float64 ? point
                                     : Point2<double>{static_cast<double>(static_cast<float>(point.x)),
                                                      static_cast<double>(static_cast<float>(point.y))};
}

/// Where the file would have a point of the local frame: rounded_to() of what has left it.
inline __device__ Point2<double> stored_point(const LocalFrame& frame, Point2<double> local, Storage storage) {
  return rounded_point(frame.leave(local, largest_stored(storage)), storage);
}

}  // namespace trismooth::cuda

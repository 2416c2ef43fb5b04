#pragma once

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"

namespace trismooth::cuda {

/// Where the file would have a point of the local frame: rounded_to() of what has left it.
inline __device__ Point2<double> stored_point(const LocalFrame& frame, Point2<double> local, Storage storage) {
  const Point2<double> left = frame.leave(local, largest_stored(storage));
  return storage == Storage::float64 ? left
                                     : Point2<double>{static_cast<double>(static_cast<float>(left.x)),
                                                      static_cast<double>(static_cast<float>(left.y))};
}

}  // namespace trismooth::cuda

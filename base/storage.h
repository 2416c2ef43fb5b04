// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/rounding.h"

namespace trismooth {

/// The number type in which the caller stores the coordinates; results are rounded to it before they are judged.
enum class Storage : std::uint8_t {
  float64,  ///< double
  float32,  ///< float
};

/// The largest coordinate that can be stored.
constexpr TRISMOOTH_HOST_DEVICE double largest_stored(Storage storage) {
  return storage == Storage::float64 ? std::numeric_limits<double>::max()
                                     : static_cast<double>(std::numeric_limits<float>::max());
}

/// A coordinate as it will be stored. On the host.
inline double rounded_to(Storage storage, double value) {
  return storage == Storage::float64 ? value : rounded_to_float32(value);
}

/// A point as it will be stored. On the host.
inline Point2<double> rounded_to(Storage storage, Point2<double> point) {
  return {rounded_to(storage, point.x), rounded_to(storage, point.y)};
}

}  // namespace trismooth

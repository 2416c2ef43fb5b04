#pragma once

#include <limits>

#include "trismooth/quality/host_device.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// The largest coordinate that can be stored.
constexpr TRISMOOTH_HOST_DEVICE double largest_stored(Storage storage) {
  return storage == Storage::float64 ? std::numeric_limits<double>::max()
                                     : static_cast<double>(std::numeric_limits<float>::max());
}

}  // namespace trismooth

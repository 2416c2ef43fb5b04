// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/local_frame.h"

namespace trismooth {

LocalFrame local_frame(std::span<const Point2<double>> stored) {
  return local_frame(stored, [](std::size_t) { return true; });
}

}  // namespace trismooth

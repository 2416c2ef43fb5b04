// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/exact_arithmetic.h"

namespace trismooth {

/// The float32 nearest to `value`. Where a file stores float32, coordinates must be rounded by this.
inline double rounded_to_float32(double value) {
  // Through memory: GCC 12 vectorises a pair of such conversions into nothing and leaves the numbers as they were.
  const volatile auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace trismooth

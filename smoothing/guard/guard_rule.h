// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"

namespace trismooth {

/// The quotient that an element was brought down to, for the never-worse guard: `after` where it got worse, minus
/// infinity where it was valid and is not any more or `after` is no number, infinity where it is as good as it was or
/// better. So an element offends where this is below T, and the smallest of many elements tells of all of them. (No
/// branch, which loops over lanes cannot have: & and | are meant.)
constexpr TRISMOOTH_HOST_DEVICE double worsened_quotient(double before, double after) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool is_lost = ((before > 0) & !(after > 0)) | !(after - after == 0);
  const double worse = after < before ? after : infinity;
  return is_lost ? -infinity : worse;
}

/// An element was made worse: it was valid and is not any more, or is below `threshold` now and below what it was.
constexpr TRISMOOTH_HOST_DEVICE bool offends(double before, double after, double threshold) {
  return worsened_quotient(before, after) < threshold;
}

}  // namespace trismooth

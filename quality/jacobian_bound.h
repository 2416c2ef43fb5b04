// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"

namespace trismooth {

/// The smallest value that the determinant J of the Jacobian of a quadratic element has on it, in units of the local
/// frame. The element is the image of the triangle (0, 0), (1, 0), (0, 1), or of the square from 0 to 1.
struct JacobianBound {
  double straight = 0;  ///< the mean of J, were all sides straight: twice a triangle's area, a quadrilateral's area
  double lowest = 0;    ///< the smallest value of J, but for `rounding`
  double rounding = 0;  ///< how far rounding, and of a quadrilateral the end of the search, may have brought `lowest`
                        ///< off: some 2e-12 of width times height of a triangle, 1e-6 of the largest J of others

  /// J is positive everywhere, rounding allowed for.
  constexpr TRISMOOTH_HOST_DEVICE bool is_valid() const { return lowest > rounding; }
  /// J is somewhere below 0, rounding allowed for, or the corners enclose no area. An element may be neither valid nor
  /// this: where the smallest J is 0 to rounding, as at a crack's tip whose middles are at a quarter of their sides.
  constexpr TRISMOOTH_HOST_DEVICE bool is_invalid() const { return lowest < -rounding || straight == 0; }
  /// The smallest J by `straight`: 1 of a triangle or a parallelogram whose sides are straight with their middles in
  /// the middle, below 0 where the element is not valid. Minus infinity where the corners enclose no area.
  constexpr TRISMOOTH_HOST_DEVICE double scaled() const {
    const double size = straight < 0 ? -straight : straight;
    return size > 0 ? lowest / size : -std::numeric_limits<double>::infinity();
  }
};

}  // namespace trismooth

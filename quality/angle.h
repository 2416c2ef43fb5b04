// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "trismooth/base/exact_arithmetic.h"

namespace trismooth {

/// The angle of the point (x, y) with y > 0 from the x axis, in radians: atan2(y, x), within two units in the last
/// place. Our own, since that of a C library is not the same everywhere and cannot be computed for several triangles at
/// once. Without branches, for the same reason; where both are 0 or infinite, it is any number.
///
/// The point is turned by multiples of 45 degrees to within 22.5 degrees of the axis, whose quotient goes into the
/// rational approximation of S. L. Moshier's Cephes library (atan.c, 1984).
inline double angle_above_axis(double y, double x) {
  constexpr double pi = std::numbers::pi;
  constexpr double tangent_of_eighth = 0.41421356237309503;  // of a half-turn
  const double across = std::abs(x);
  const bool is_steep = y > across;
  const double shorter = is_steep ? across : y;
  const double longer = is_steep ? y : across;
  const bool is_turned = shorter > tangent_of_eighth * longer;
  const double numerator = is_turned ? shorter - longer : shorter;
  const double denominator = is_turned ? shorter + longer : longer;
  const double tangent = numerator / denominator;
  const double square = tangent * tangent;
  const double above =
      (((-8.750608600031904122785e-1 * square - 1.615753718733365076637e1) * square - 7.500855792314704667340e1) *
           square -
       1.228866684490136173410e2) *
          square -
      6.485021904942025371773e1;
  const double below = ((((square + 2.485846490142306297962e1) * square + 1.650270098316988542046e2) * square +
                         4.328810604912902668951e2) *
                            square +
                        4.853903996359136964868e2) *
                           square +
                       1.945506571482613964425e2;
  const double within = tangent + tangent * (square * above / below);
  const double turned_back = is_turned ? pi / 4 + within : within;
  const double first_quadrant = is_steep ? pi / 2 - turned_back : turned_back;
  return x < 0 ? pi - first_quadrant : first_quadrant;
}

}  // namespace trismooth

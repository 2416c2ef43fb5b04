// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"

namespace trismooth {

/// The centre of a ring's kernel: the places that see every edge of the polygon `ring` (counter-clockwise) from the
/// left, so that no triangle with that edge and such a place is inverted. Nothing where there is no such place. The
/// centre is the mean of the kernel's corners. `scratch` is memory to work in. Complexity: the square of the ring.
std::optional<Point2<double>> kernel_centre(std::span<const Point2<double>> ring, std::vector<Point2<double>>& scratch);

}  // namespace trismooth

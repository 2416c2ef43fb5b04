// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"

namespace trismooth {

/// A straight line from one point to another.
using Chord = std::array<Point2<double>, 2>;

/// The centre of a ring's kernel: the places that see every edge of the polygon `ring` (counter-clockwise) from the
/// left, so that no triangle with that edge and such a place is inverted. Nothing where there is no such place. The
/// centre is the mean of the kernel's corners. `scratch` is memory to work in. Complexity: the square of the ring.
///
/// `chords`: between corners of the polygon, which the places see from the left as well: those that cut off the
/// opposite vertices of quadrilaterals, in which the place has a corner that does not point inwards then.
std::optional<Point2<double>> kernel_centre(std::span<const Point2<double>> ring, std::vector<Point2<double>>& scratch,
                                            std::span<const Chord> chords = {});

}  // namespace trismooth

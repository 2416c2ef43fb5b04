// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "trismooth/base/point2.h"
#include "trismooth/quality/jacobian_bound.h"

namespace trismooth {

/// The nodes of a quadrilateral: its corners 0 to 3, counter-clockwise, the middles of 01, 12, 23 and 30, the centre.
/// Coordinates are of the local frame.
using BiquadraticNodes = std::array<Point2<double>, 9>;

/// Where the centre of a quadrilateral of eight nodes is, by the map that these nodes have: half of the middles less a
/// quarter of the corners. With it, the element is that of nine nodes.
Point2<double> centre_of_eight(const BiquadraticNodes& nodes);

/// The smallest J of a quadrilateral of nine nodes, with curved sides, on the whole of it. J is a polynomial of degree
/// 3 in each of both directions; the smallest coefficient of its Bernstein basis is never above its smallest value,
/// and those of small parts come as close as one likes (A. Johnen, J.-F. Remacle and C. Geuzaine, "Geometrical validity
/// of curvilinear finite elements", Journal of Computational Physics 233 (2013), 359-372). So the element is divided
/// until they are within a millionth of the largest coefficient. Constant time where the smallest J is at a corner, as
/// on nearly all elements; else that of some hundred parts, and where J is nearly 0 all along a curve of some ten
/// thousand.
JacobianBound jacobian_bound(const BiquadraticNodes& nodes);

}  // namespace trismooth

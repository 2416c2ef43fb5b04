// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/untangle/patch.h"

namespace trismooth {

class Workers;

/// Puts every vertex that may move to the mean of its neighbours, all at once, by conjugate gradients from where they
/// are. Where the patch is convex and its interior connected this is an embedding: no triangle is inverted (W. T.
/// Tutte, How to draw a graph, 1963); elsewhere it is a start. Neighbours are those along sides: where quadrilaterals
/// are embedded, and none has corners in line on the edge of the patch, they are convex. `points`: one for each vertex
/// of the patch.
/// `tolerance`: of the residual, as a part of what it was at the centre of the held vertices.
/// Complexity: the patch times the root of its size.
void tutte(const Patch& patch, std::span<Point2<double>> points, double tolerance, Workers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/untangle/patch.h"

namespace trismooth {

class Workers;

/// Untangles a patch from few vertices to all. Edges are collapsed until about a thousand of its free vertices are
/// left, without a look at where they are; these are embedded (tutte()) and brought down in energy
/// (minimise_regularised()); then the collapses are undone one by one. If no triangle is inverted, there is room for
/// each vertex that comes back: the kernel of its ring is not empty (H. Shen, Z. Jiang, D. Zorin, D. Panozzo:
/// Progressive embedding, 2019). So what is wrong with the mesh as a whole is mended where it is small. Shapes are
/// improved in between. Quadrilaterals are two triangles for all this, and brought down in energy at the end.
///
/// `points`: one for each vertex of the patch; those of free vertices are not looked at, and get the result. They stay
/// where quadrilaterals cannot be cut in two, since in either way an edge would be there twice.
/// Complexity: the patch times the root of its size.
void untangle_coarse_to_fine(const Patch& patch, std::span<Point2<double>> points, Workers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/untangle/patch.h"

namespace trismooth {

class Workers;

/// Minimises the regularised energy of the patch (RegularisedEnergy), of its triangles and the corners of its
/// quadrilaterals, by Newton's method with the positive part of the Hessian. The regularisation is a fifth of the
/// smallest D, and falls with it. Ends when none of these is inverted and the shapes have had a few steps more, when
/// nothing is gained any more, or when `most_steps` are done. `points` holds the start and gets the result. Complexity:
/// a step is conjugate gradients on the patch.
void minimise_regularised(const Patch& patch, std::span<Point2<double>> points, int most_steps, Workers& workers);

}  // namespace trismooth

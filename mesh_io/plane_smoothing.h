#pragma once

#include <span>
#include <vector>

#include "trismooth/mesh_io/plane.h"
#include "trismooth/smoothing/one_rings.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// Smooths points of space within their plane, given their one-rings. `xyz` are the stored coordinates (three of every
/// vertex), changed in place and rounded to `storage`; `points` are plane.project() of them and get the projections of
/// the result. `local` are `points` in their local frame. Everything else as PreparedSmoother::smooth. In a tilted
/// plane the commit judges the projections of what is stored, since storing rounds in space.
SmoothingResult smooth_in_plane(const OneRings& rings, const Plane& plane, std::span<double> xyz,
                                std::vector<Point2<double>>& points, std::span<const Point2<double>> local,
                                double fixed_quotient, Storage storage, const SmoothingOptions& options);

}  // namespace trismooth

#pragma once

#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/mesh_io/halfedge/plane.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

/// Smooths points of space within their plane, given their one-rings. `xyz` are the stored coordinates (three of every
/// vertex), changed in place and rounded to `storage`; `points` are plane.project() of them and get the projections of
/// the result. `frame` is the local frame of those that cells use, `local` are `points` in it. Everything else as
/// PreparedSmoother::smooth. In a tilted plane the commit judges the projections of what is stored, since storing
/// rounds in space.
SmoothingResult smooth_in_plane(const OneRings& rings, const Plane& plane, std::span<double> xyz,
                                std::vector<Point2<double>>& points, const LocalFrame& frame,
                                std::span<const Point2<double>> local, double fixed_quotient, Storage storage,
                                const SmoothingOptions& options);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/pipeline/generate/grid_predicates.h"

namespace trismooth {

/// The Delaunay triangulation of `points`, which are distinct: index triples, counter-clockwise, none degenerate, that
/// fill the convex hull exactly. Every point is a corner of some triangle, and no circle through a triangle's corners
/// has a point strictly inside. All decisions are exact. Where four or more points lie on one empty circle there are
/// several such triangulations; which one comes out, and in what order its triangles stand, depends on the points and
/// their order alone. Fewer than three points, or points that are all collinear, give no triangle.
///
/// Throws std::invalid_argument for a coordinate outside [0, 2^30) and for a point that occurs twice,
/// std::length_error for more than 2^31 / 6 points.
/// Complexity: O(n log n) for the sorting and O(n) expected for the rest where points are spread at random; O(n^2) at
/// worst. Memory: about 60 bytes a point beside the result's 24.
std::vector<std::array<std::int32_t, 3>> delaunay(std::span<const GridPoint> points);

}  // namespace trismooth

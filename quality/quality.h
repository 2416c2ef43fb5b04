#pragma once

#include "trismooth/base/array_layout.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/point_view.h"
#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// The quality of a mesh in the caller's arrays, which are read and left as they are. Takes what smooth() takes, and
/// const arrays as well: `quality(xy_points(xy), triangles)`.
///
/// As everywhere, triangles may be listed in either direction: orientation is made consistent per component (triangles
/// connected through edges of exactly two triangles), and what the majority of a component's triangles is counts as
/// positive. Only triangles that are negative then are inverted. Lengths, areas and the centroids of the worst elements
/// are in the caller's units. A third number of a point is its height, and must be the same for all vertices that
/// triangles use, to within 1e-6 of their extent.
///
/// Throws MeshError for triangles that are no mesh (an index out of range, a triangle that repeats a vertex, a
/// component that cannot be oriented), for a coordinate that is not finite and for heights that differ;
/// std::invalid_argument for a number of threads out of range. Complexity: linear, but for sorting the edges of each
/// vertex. The report is the same to the bit for every number of threads.
[[nodiscard]] QualityReport quality(const ConstPointView& points, const IndexView& triangles,
                                    const QualityOptions& options = {});

/// A plain array does not say whether it holds x and y or x, y and z of a vertex: say xy_points(array) or
/// xyz_points(array).
template <array_layout::Numbers R>
QualityReport quality(R&& xy_or_xyz, const IndexView& triangles, const QualityOptions& options = {}) = delete;

}  // namespace trismooth

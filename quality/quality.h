// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/point_view.h"
#include "trismooth/quality/metrics.h"
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
/// Where `triangles` has four numbers of each, quadrilaterals are among them (see IndexView): they are oriented
/// together with the triangles that they share edges with, a quadrilateral is positive where its area is, and inverted
/// where a corner of it points inwards then, degenerate where one is flat. The report is of all elements, and
/// QualityReport::kinds of each kind.
///
/// Throws MeshError for triangles that are no mesh (an index out of range, a triangle that repeats a vertex, a
/// component that cannot be oriented), for a coordinate that is not finite and for heights that differ;
/// std::invalid_argument for a number of threads out of range. Complexity: linear, but for sorting the edges of each
/// vertex. The report is the same to the bit for every number of threads.
[[nodiscard]] QualityReport quality(const ConstPointView& points, const IndexView& triangles,
                                    const QualityOptions& options = {});

/// Where the caller wants the values of a metric: for every element one, in the order of the elements; or nothing.
/// Indexed by Metric. NaN of elements whose kind has none of it.
using ElementValues = std::array<std::span<double>, metric_count>;

/// The report, and the value of each metric asked for of every element: what the report sums up. Areas are in the
/// caller's units; values may be infinite (see evaluate()), NaN only where the kind of element has none of the metric.
/// The caller owns `values`; throws std::invalid_argument unless each is empty or has one place an element.
QualityReport quality(const ConstPointView& points, const IndexView& triangles, const ElementValues& values,
                      const QualityOptions& options = {});

/// A mesh whose elements are analysed once, and whose quality is asked for as often as its points change. Owns a copy
/// of the elements. Several threads may ask at the same time.
class MeshQuality {
 public:
  /// Throws as quality() does for triangles, and for `threads` (0: all).
  MeshQuality(std::int64_t vertex_count, const IndexView& triangles, int threads = 0);
  MeshQuality(MeshQuality&&) noexcept;
  MeshQuality& operator=(MeshQuality&&) noexcept;
  ~MeshQuality();

  /// What quality() gives for these points, one for every vertex; std::invalid_argument for another number of them.
  /// Linear.
  [[nodiscard]] QualityReport report(const ConstPointView& points, const QualityOptions& options = {}) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// A plain array does not say whether it holds x and y or x, y and z of a vertex: say xy_points(array) or
/// xyz_points(array).
template <array_layout::Numbers R>
QualityReport quality(R&& xy_or_xyz, const IndexView& triangles, const QualityOptions& options = {}) = delete;
/// Points of a type that does not say where their numbers are: what to write instead is in the compiler's message.
template <array_layout::OtherPoints R>
QualityReport quality(R&& /*points*/, const IndexView& /*triangles*/, const QualityOptions& /*options*/ = {}) {
  array_layout::refuse_points<R>();
  return {};
}

}  // namespace trismooth

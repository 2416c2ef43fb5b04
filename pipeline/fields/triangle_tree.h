// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/box.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/pipeline/fields/mesh_place.h"

namespace trismooth {

/// Finds the triangle that is nearest to a point: a tree of boxes over the triangles in the order of a Morton curve.
/// Memory linear in the triangles.
class TriangleTree {
 public:
  /// The spans must outlive it; points are in a local frame. Complexity: n log n.
  TriangleTree(std::span<const Point2<double>> points, std::span<const Triangle> triangles);

  /// The place in the triangles of one region (`regions` has that of each, none: there is one) that is nearest to `at`,
  /// of several the one in the triangle of the lowest number. Nowhere if the region has no triangle.
  MeshPlace nearest(Point2<double> at, std::span<const std::int32_t> regions, std::int32_t region) const;

 private:
  struct Search;

  void look(Search& search, std::size_t level, std::size_t node) const;

  std::span<const Point2<double>> points_;
  std::span<const Triangle> triangles_;
  std::vector<std::int32_t> order_;       ///< triangles along the curve
  std::vector<std::vector<Box>> levels_;  ///< boxes of leaves first, that of all triangles last
};

}  // namespace trismooth

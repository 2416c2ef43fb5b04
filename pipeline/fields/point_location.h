// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/pipeline/fields/mesh_place.h"

namespace trismooth {

class Workers;

/// Finds where vertices of a mesh that have moved lie in the mesh as it was.
class PointLocation {
 public:
  /// `points` are the mesh's, in a local frame; `regions` has that of each triangle, or there is none. The spans must
  /// outlive it. Complexity: linear.
  PointLocation(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                std::span<const std::int32_t> regions);

  /// The place of each of the `vertices`, which is at `moved` now (one for every vertex of the mesh, in the same
  /// frame): one of the triangles that hold that point, in the region of the triangles that the vertex is in, or where
  /// none does the nearest point of those. A vertex in no triangle is nowhere. The same bits for every number of
  /// workers.
  ///
  /// A walk from the triangles around the vertex finds nearly all; it is given up after a number of steps that does
  /// not depend on the mesh, and where it meets an end or another region. A tree over all triangles finds those.
  std::vector<MeshPlace> places_of(std::span<const std::int32_t> vertices, std::span<const Point2<double>> moved,
                                   Workers& workers) const;

 private:
  class Walk;

  std::span<const std::int32_t> triangles_at(std::int32_t vertex) const;
  CornerAreas areas_at(std::int32_t triangle, Point2<double> at) const;
  std::int32_t region_of(std::int32_t triangle) const;

  std::span<const Point2<double>> points_;
  std::span<const Triangle> triangles_;
  std::span<const std::int32_t> regions_;
  std::vector<std::size_t> first_of_vertex_;
  std::vector<std::int32_t> triangles_of_vertices_;
};

}  // namespace trismooth

#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/local_points.h"
#include "trismooth/mesh_io/halfedge/plane.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

/// Smooths points of space within their plane. `mesh` is what was found of the `triangles`; its rings, the
/// most memory of all, are gone afterwards. `xyz` are the stored
/// coordinates (three of every vertex), changed in place and rounded to `storage`; `points` are plane.project() of them
/// and get the projections of the result. `local` are `points` in the local frame of those that cells use. Everything
/// else as Backend::prepare() and PreparedSmoother::smooth(). In a tilted plane the guard judges the projections of
/// what is stored, since storing rounds in space.
SmoothingResult smooth_in_plane(MeshRings& mesh, std::span<const Triangle> triangles, const Plane& plane,
                                std::span<double> xyz, BulkVector<Point2<double>>& points, const LocalPoints& local,
                                Storage storage, const SmoothingOptions& options);

/// Points of space and where they lie in the image in which they are smoothed.
struct SpaceImage {
  /// The place of a vertex that is stored there.
  std::function<Point2<double>(std::size_t vertex, const Eigen::Vector3d& stored)> place;
  /// What is stored of a vertex that moves in the image, before it is rounded.
  std::function<Eigen::Vector3d(const Eigen::Vector3d& stored, Point2<double> from, Point2<double> to)> moved;
};

/// The same in any image: `points` are there, and the guard judges the images of what is stored.
SmoothingResult smooth_in_image(MeshRings& mesh, std::span<const Triangle> triangles, const SpaceImage& image,
                                std::span<double> xyz, BulkVector<Point2<double>>& points, const LocalPoints& local,
                                Storage storage, const SmoothingOptions& options);

}  // namespace trismooth

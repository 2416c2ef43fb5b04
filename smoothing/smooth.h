#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "trismooth/base/index_view.h"
#include "trismooth/base/point_view.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// A mesh whose connectivity is analysed once and whose coordinates are smoothed as often as they change (moving
/// meshes). Owns copies of all it needs; the caller's arrays may go. Can be moved; what was moved from can be assigned
/// to and destroyed, its smooth() throws std::logic_error. One thread at a time may use a plan; several plans may be
/// used at the same time. With a backend that runs on a device: from threads that have the same device current.
class SmoothingPlan {
 public:
  /// `triangles`: three vertex numbers each, listed in either direction; orientation is made consistent per component.
  /// Throws MeshError for triangles that are no mesh (see connect_triangles), std::invalid_argument for options or
  /// constraints that do not fit. Complexity: linear, but for sorting the edges of each vertex.
  SmoothingPlan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints,
                const SmoothingOptions& options);
  SmoothingPlan(SmoothingPlan&&) noexcept;
  SmoothingPlan& operator=(SmoothingPlan&&) noexcept;
  ~SmoothingPlan();

  /// Smooths the points, one for every vertex, in place. Vertices that do not move keep their bits, the others are
  /// rounded to `storage`, or to float where the points are. The mesh lies in the plane of x and y: a third number of a
  /// point is its height, which stays as it is and must be the same for all vertices that triangles use, to within 1e-6
  /// of their extent. The first call also orders the mesh in memory; a later one repeats that only if the majority
  /// orientation of a component has changed. Throws std::invalid_argument for a wrong number of points, MeshError for a
  /// coordinate that is not finite and for heights that differ, DeviceError; the points are untouched then.
  SmoothingResult smooth(const PointView& points, Storage storage = Storage::float64);

  /// The same for a plain array of float or double: x and y of every vertex, 2 n numbers.
  template <array_layout::CoordinateNumbers R>
  SmoothingResult smooth(R&& xy, Storage storage = Storage::float64) {
    return smooth(xy_points(xy), storage);
  }

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The same, as a function: `auto p = plan(n, triangles, constraints, options); p.smooth(points);`
SmoothingPlan plan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints = {},
                   const SmoothingOptions& options = {});

/// Smooths the caller's points in place, once. For arguments, errors and guarantees see SmoothingPlan.
SmoothingResult smooth(const PointView& points, const IndexView& triangles, const Constraints& constraints = {},
                       const SmoothingOptions& options = {});

/// A plain array does not say whether it holds x and y or x, y and z of a vertex: say xy_points(array) or
/// xyz_points(array).
template <array_layout::Numbers R>
SmoothingResult smooth(R&& xy_or_xyz, const IndexView& triangles, const Constraints& constraints = {},
                       const SmoothingOptions& options = {}) = delete;

/// The backend that the options name, or the CPU's.
const Backend& backend_of(const SmoothingOptions& options);

/// The rings of a mesh as the options want them found: by their backend where they say Topology::device and it finds
/// rings, else on the host, by find_mesh_rings() with `workers` and `find_rings`. The same numbers either way.
MeshRings rings_for(const SmoothingOptions& options, std::span<const Point2<double>> points,
                    std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                    const RingFinder& find_rings = {});

}  // namespace trismooth

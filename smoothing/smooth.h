#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// A mesh whose connectivity is analysed once and whose coordinates are smoothed as often as they change (moving
/// meshes). Owns copies of all it needs; the caller's arrays may go. One thread at a time may use a plan; several plans
/// may be used at the same time. With a backend that runs on a device: from threads that have the same device current.
class SmoothingPlan {
 public:
  /// `triangles`: 3 m vertex indices from 0, listed in either direction; orientation is made consistent per component.
  /// Throws MeshError for triangles that are no mesh (see connect_triangles), std::invalid_argument for options or
  /// constraints that do not fit. Complexity: linear, but for sorting the edges of each vertex.
  SmoothingPlan(std::int32_t vertex_count, std::span<const std::int32_t> triangles, const Constraints& constraints,
                const SmoothingOptions& options);

  /// Smooths `xy` (x and y of every vertex: 2 n numbers) in place. Vertices that do not move keep their bits, the
  /// others are rounded to `storage`. The first call also orders the mesh in memory; a later one repeats that only if
  /// the majority orientation of a component has changed. Throws std::invalid_argument for a wrong length, MeshError
  /// for a coordinate that is not finite, DeviceError; `xy` is untouched then.
  SmoothingResult smooth(std::span<double> xy, Storage storage = Storage::float64);

 private:
  SmoothingOptions options_;
  std::unique_ptr<PreparedMesh> mesh_;  ///< of a backend that analyses meshes itself; the rest is empty then
  std::vector<Triangle> triangles_;
  TriangleTopology topology_;
  std::vector<std::uint8_t> fixed_;
  std::vector<std::uint8_t> reversed_;
  std::unique_ptr<PreparedSmoother> smoother_;
};

/// The same, as a function: `auto p = plan(n, triangles, constraints, options); p.smooth(xy);`
SmoothingPlan plan(std::int32_t vertex_count, std::span<const std::int32_t> triangles,
                   const Constraints& constraints = {}, const SmoothingOptions& options = {});

/// Smooths the caller's flat arrays in place, once: xy holds x and y of every vertex, triangles three vertex indices
/// each. For arguments, errors and guarantees see SmoothingPlan.
SmoothingResult smooth(std::span<double> xy, std::span<const std::int32_t> triangles,
                       const Constraints& constraints = {}, const SmoothingOptions& options = {});

/// The backend that the options name, or the CPU's.
const Backend& backend_of(const SmoothingOptions& options);

/// The rings of a mesh as the options want them found: by their backend where they say Topology::device and it finds
/// rings, else on the host, by find_mesh_rings() with `workers` and `find_rings`. The same numbers either way.
MeshRings rings_for(const SmoothingOptions& options, std::span<const Point2<double>> points,
                    std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                    const RingFinder& find_rings = {});

}  // namespace trismooth

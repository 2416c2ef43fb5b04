#include "trismooth/mesh_io/halfedge/plane_smoothing.h"

#include <algorithm>
#include <cmath>

#include "trismooth/base/stopwatch.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/untangle/untangle.h"

namespace trismooth {

namespace {

bool is_finite(const Eigen::Vector3d& point) {
  return std::isfinite(point.x()) && std::isfinite(point.y()) && std::isfinite(point.z());
}

bool is_finite(Point2<double> point) {
  return std::isfinite(point.x) && std::isfinite(point.y);
}

/// The rings in the orientation that the smoothed mesh has, where untangling has turned it over.
OneRings turned_rings(const MeshRings& mesh, std::span<const Triangle> triangles, const LocalPoints& local,
                      const std::vector<Point2<double>>& moved, const SmoothingOptions& options) {
  Workers workers(options.threads);
  std::vector<Point2<double>> now;
  for (const Point2<double> point : moved) {
    now.push_back(local.frame.enter(point));
  }
  const auto topology = connect_triangles(static_cast<std::int32_t>(moved.size()), triangles, workers);
  return one_rings(topology, triangles, orient(topology, triangles, now).reversed, mesh.fixed, workers);
}

/// Stores the vertices that moved from `points` to `moved` and judges them by what was stored.
void guard_in_space(const OneRings& rings, const Plane& plane, std::span<double> xyz,
                    std::vector<Point2<double>>& points, const LocalPoints& local,
                    const std::vector<Point2<double>>& moved, Storage storage, const SmoothingOptions& options,
                    SmoothingResult& result) {
  const Stopwatch watch;
  std::vector<Eigen::Vector3d> stored(points.size());
  const std::vector<Point2<double>>& before = local.points;
  std::vector<Point2<double>> after = before;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (moved[v] == points[v]) {
      continue;
    }
    const Eigen::Vector3d old = Eigen::Map<const Eigen::Vector3d>(xyz.data() + 3 * v);
    stored[v] = rounded_to(storage, plane.moved(old, points[v], moved[v]));
    // Near the largest double, the step to a place within range may be beyond it: the vertex stays.
    const Point2<double> place = plane.project(stored[v]);
    if (is_finite(stored[v]) && is_finite(place)) {
      after[v] = local.frame.enter(place);
    }
  }
  if (options.guard) {
    Workers workers(options.threads);
    const GuardOutcome outcome = keep_never_worse(rings.view(), before, after, workers);
    result.guard_rounds += outcome.rounds;
    for (const std::int32_t v : outcome.reverted) {
      result.reverted.push_back({v, moved[v]});
    }
    name_once(result.reverted);
    result.reverted_vertices = std::ssize(result.reverted);
  }
  if (result.untangling) {
    Workers workers(options.threads);
    result.untangling->inverted_after = inverted_triangles(rings.view(), after, workers);
  }
  result.moved_vertices = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!(after[v] == before[v])) {
      Eigen::Map<Eigen::Vector3d>(xyz.data() + 3 * v) = stored[v];
      points[v] = plane.project(stored[v]);
      ++result.moved_vertices;
    }
  }
  result.timings.commit += watch.milliseconds();
}

}  // namespace

SmoothingResult smooth_in_plane(const MeshRings& mesh, std::span<const Triangle> triangles, const Plane& plane,
                                std::span<double> xyz, std::vector<Point2<double>>& points, const LocalPoints& local,
                                Storage storage, const SmoothingOptions& options) {
  SmoothingOptions in_plane = options;
  // What has been untangled needs the guard that knows what the sweeps began with, too.
  in_plane.guard = options.guard && (plane.aligned || options.untangles());
  const auto smoother = backend_of(options).prepare(mesh, triangles, local.points, in_plane);
  if (!plane.aligned) {
    std::vector<Point2<double>> moved = points;
    SmoothingResult result = smoother->smooth(moved, Storage::float64, local.frame);
    const bool is_turned = result.untangling && result.untangling->turned_components > 0;
    guard_in_space(is_turned ? turned_rings(mesh, triangles, local, moved, options) : mesh.rings, plane, xyz, points,
                   local, moved, storage, options, result);
    return result;
  }
  SmoothingResult result = smoother->smooth(points, storage, local.frame);
  for (std::size_t v = 0; v < points.size(); ++v) {
    Eigen::Map<Eigen::Vector3d> point(xyz.data() + 3 * v);
    if (const Point2<double> before = plane.project(point); !(before == points[v])) {
      point = rounded_to(storage, plane.moved(point, before, points[v]));
    }
  }
  return result;
}

}  // namespace trismooth

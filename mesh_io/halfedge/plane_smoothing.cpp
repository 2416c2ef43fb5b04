#include "trismooth/mesh_io/halfedge/plane_smoothing.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/stopwatch.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/untangle/untangle_mesh.h"

namespace trismooth {

namespace {

/// Vertices that a thread takes at a time.
constexpr std::int64_t space_grain = 8192;

bool is_finite(const Eigen::Vector3d& point) {
  return std::isfinite(point.x()) && std::isfinite(point.y()) && std::isfinite(point.z());
}

bool is_finite(Point2<double> point) {
  return std::isfinite(point.x) && std::isfinite(point.y);
}

/// Stores the vertices that moved from `points` to `moved` and judges them by what was stored.
void guard_in_space(const MeshRings& mesh, std::span<const Triangle> triangles, const SpaceImage& image,
                    std::span<double> xyz, BulkVector<Point2<double>>& points, const LocalPoints& local,
                    const BulkVector<Point2<double>>& moved, Storage storage, const SmoothingOptions& options,
                    SmoothingResult& result) {
  const Stopwatch watch;
  Workers workers(options.threads);
  const RingView rings = mesh.rings.view();
  std::vector<Eigen::Vector3d> stored(points.size());
  const BulkVector<Point2<double>>& before = local.points;
  BulkVector<Point2<double>> after = before;
  workers.for_blocks(std::ssize(points), space_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      if (moved[v] == points[v]) {
        continue;
      }
      const Eigen::Vector3d old = Eigen::Map<const Eigen::Vector3d>(xyz.data() + 3 * v);
      stored[v] = rounded_to(storage, image.moved(old, points[v], moved[v]));
      // Near the largest double, the step to a place within range may be beyond it: the vertex stays.
      const Point2<double> place = image.place(v, stored[v]);
      if (is_finite(stored[v]) && is_finite(place)) {
        after[v] = local.frame.enter(place);
      }
    }
  });
  TurnedComponents turned;
  if (result.untangling) {
    turned = {result.untangling->turned_components, std::move(result.untangling->turned)};
  }
  if (options.guard) {
    const GuardOutcome outcome = keep_never_worse(rings, triangles, mesh.reversed, turned, before, after, workers);
    result.guard_rounds += outcome.rounds;
    for (const std::int32_t v : outcome.reverted) {
      result.reverted.push_back({v, moved[v]});
    }
  }
  if (result.untangling && !(options.guard && result.untangling->inverted_before == 0)) {
    result.untangling->inverted_after = inverted_triangles(rings, triangles, turned, after, workers);
    result.untangling->turned_components = turned.count;
    result.untangling->turned = std::move(turned.triangles);
  }
  std::atomic<std::int64_t> elsewhere{0};
  workers.for_blocks(std::ssize(points), space_grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t elsewhere_here = 0;
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      if (!(after[v] == before[v])) {
        Eigen::Map<Eigen::Vector3d>(xyz.data() + 3 * v) = stored[v];
        points[v] = image.place(v, stored[v]);
        ++elsewhere_here;
      }
    }
    elsewhere.fetch_add(elsewhere_here, std::memory_order_relaxed);
  });
  result.moved_vertices = elsewhere;
  if (options.guard) {
    name_reverted(result, points);
  }
  result.timings.commit += watch.milliseconds();
}

}  // namespace

SmoothingResult smooth_in_image(MeshRings& mesh, std::span<const Triangle> triangles, const SpaceImage& image,
                                std::span<double> xyz, BulkVector<Point2<double>>& points, const LocalPoints& local,
                                Storage storage, const SmoothingOptions& options) {
  SmoothingOptions in_image = options;
  // What has been untangled needs the guard that knows what the sweeps began with, too.
  in_image.guard = options.guard && options.untangles();
  // The guard in space asks for the rings once more.
  const auto smoother = backend_of(options).prepare(mesh, triangles, local.points, in_image);
  BulkVector<Point2<double>> moved = points;
  SmoothingResult result = smoother->smooth(moved, Storage::float64, local.frame);
  guard_in_space(mesh, triangles, image, xyz, points, local, moved, storage, options, result);
  mesh.rings = {};
  return result;
}

SmoothingResult smooth_in_plane(MeshRings& mesh, std::span<const Triangle> triangles, const Plane& plane,
                                std::span<double> xyz, BulkVector<Point2<double>>& points, const LocalPoints& local,
                                Storage storage, const SmoothingOptions& options) {
  if (!plane.aligned) {
    const SpaceImage image{[&plane](std::size_t, const Eigen::Vector3d& stored) { return plane.project(stored); },
                           [&plane](const Eigen::Vector3d& stored, Point2<double> from, Point2<double> to) {
                             return plane.moved(stored, from, to);
                           }};
    return smooth_in_image(mesh, triangles, image, xyz, points, local, storage, options);
  }
  const auto smoother = backend_of(options).prepare(with_rings_of(mesh), triangles, local.points, options);
  SmoothingResult result = smoother->smooth(points, storage, local.frame);
  Workers(options.threads).for_blocks(std::ssize(points), space_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      Eigen::Map<Eigen::Vector3d> point(xyz.data() + 3 * v);
      if (const Point2<double> before = plane.project(point); !(before == points[v])) {
        point = rounded_to(storage, plane.moved(point, before, points[v]));
      }
    }
  });
  return result;
}

}  // namespace trismooth

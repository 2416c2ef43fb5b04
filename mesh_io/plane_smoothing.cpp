#include "trismooth/mesh_io/plane_smoothing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "trismooth/quality/float32_rounding.h"
#include "trismooth/quality/local_frame.h"
#include "trismooth/smoothing/never_worse.h"
#include "trismooth/smoothing/smooth.h"

namespace trismooth {

namespace {

Eigen::Vector3d rounded_to(Storage storage, const Eigen::Vector3d& point) {
  return storage == Storage::float64 ? point : point.unaryExpr(&rounded_to_float32).eval();
}

bool is_finite(const Eigen::Vector3d& point) {
  return std::isfinite(point.x()) && std::isfinite(point.y()) && std::isfinite(point.z());
}

bool is_finite(Point2<double> point) {
  return std::isfinite(point.x) && std::isfinite(point.y);
}

/// Stores the vertices that moved from `points` to `moved` and judges them by what was stored.
void commit_in_space(const OneRings& rings, const Plane& plane, std::span<double> xyz,
                     std::vector<Point2<double>>& points, const std::vector<Point2<double>>& moved, Storage storage,
                     const SmoothingOptions& options, SmoothingResult& result) {
  const auto start = std::chrono::steady_clock::now();
  const LocalFrame frame = local_frame(points);
  std::vector<Eigen::Vector3d> stored(points.size());
  std::vector<Point2<double>> before(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Eigen::Vector3d old = Eigen::Map<const Eigen::Vector3d>(xyz.data() + 3 * v);
    stored[v] = rounded_to(storage, plane.moved(old, points[v], moved[v]));
    // Near the largest double, the step to a place within range may be beyond it: the vertex stays.
    if (!is_finite(stored[v]) || !is_finite(plane.project(stored[v]))) {
      stored[v] = old;
    }
    before[v] = frame.enter(points[v]);
  }
  std::vector<Point2<double>> after(points.size());
  std::ranges::transform(stored, after.begin(), [&](const auto& p) { return frame.enter(plane.project(p)); });
  if (options.guard) {
    Workers workers(options.threads);
    const GuardOutcome outcome = keep_never_worse(rings.view(), before, after, workers);
    result.guard_rounds = outcome.rounds;
    result.reverted_vertices = static_cast<std::int64_t>(outcome.reverted.size());
    for (const std::int32_t v : outcome.reverted) {
      result.reverted.push_back({v, moved[v]});
    }
  }
  result.moved_vertices = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!(after[v] == before[v])) {
      Eigen::Map<Eigen::Vector3d>(xyz.data() + 3 * v) = stored[v];
      points[v] = plane.project(stored[v]);
      ++result.moved_vertices;
    }
  }
  result.timings.commit += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

SmoothingResult smooth_in_plane(const OneRings& rings, const Plane& plane, std::span<double> xyz,
                                std::vector<Point2<double>>& points, std::span<const Point2<double>> local,
                                double fixed_quotient, Storage storage, const SmoothingOptions& options) {
  SmoothingOptions in_plane = options;
  in_plane.guard = options.guard && plane.aligned;
  const auto smoother = backend_of(options).prepare(rings, local, in_plane);
  if (!plane.aligned) {
    std::vector<Point2<double>> moved = points;
    SmoothingResult result = smoother->smooth(moved, Storage::float64, fixed_quotient);
    commit_in_space(rings, plane, xyz, points, moved, storage, options, result);
    return result;
  }
  SmoothingResult result = smoother->smooth(points, storage, fixed_quotient);
  for (std::size_t v = 0; v < points.size(); ++v) {
    xyz[3 * v + static_cast<std::size_t>(plane.axes[0])] = points[v].x;
    xyz[3 * v + static_cast<std::size_t>(plane.axes[1])] = points[v].y;
  }
  return result;
}

}  // namespace trismooth

#include "trismooth/smoothing/smooth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "trismooth/quality/local_frame.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/hold.h"
#include "trismooth/smoothing/triangle_topology.h"

namespace trismooth {

namespace {

std::span<const Triangle> as_triangles(std::span<const std::int32_t> indices) {
  if (indices.size() % 3 != 0) {
    throw std::invalid_argument("triangles has " + std::to_string(indices.size()) + " entries, not three a triangle");
  }
  static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t));
  return {reinterpret_cast<const Triangle*>(indices.data()), indices.size() / 3};
}

std::vector<Point2<double>> as_points(std::span<const double> xy, std::int32_t vertex_count) {
  if (xy.size() != 2 * static_cast<std::size_t>(vertex_count)) {
    throw std::invalid_argument("xy has " + std::to_string(xy.size()) + " entries, expected two for each of " +
                                std::to_string(vertex_count) + " vertices");
  }
  std::vector<Point2<double>> points(static_cast<std::size_t>(vertex_count));
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v] = {xy[2 * v], xy[2 * v + 1]};
    if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y)) {
      throw MeshError("vertex " + std::to_string(v) + " has a coordinate that is not finite");
    }
  }
  return points;
}

}  // namespace

const Backend& backend_of(const SmoothingOptions& options) {
  return options.backend != nullptr ? *options.backend : cpu_backend();
}

MeshRings rings_for(const SmoothingOptions& options, std::span<const Point2<double>> points,
                    std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                    const RingFinder& find_rings) {
  if (options.topology == Topology::device) {
    if (auto found = backend_of(options).find_rings(points, triangles, constraints, options)) {
      return *std::move(found);
    }
  }
  return find_mesh_rings(points, triangles, constraints, workers, find_rings);
}

SmoothingPlan::SmoothingPlan(std::int32_t vertex_count, std::span<const std::int32_t> triangles,
                             const Constraints& constraints, const SmoothingOptions& options)
    : options_(options) {
  const std::span<const Triangle> listed = as_triangles(triangles);
  check_mesh_size(vertex_count, std::ssize(listed));
  options.validate();
  if (options.topology == Topology::device) {
    mesh_ = backend_of(options).prepare_mesh(vertex_count, listed, constraints, options);
    if (mesh_ != nullptr) {
      return;
    }
  }
  triangles_.assign(listed.begin(), listed.end());
  Workers workers(options.threads);
  topology_ = connect_triangles(vertex_count, triangles_, workers);
  fixed_ = fixed_vertices(topology_, triangles_, constraints);
}

SmoothingResult SmoothingPlan::smooth(std::span<double> xy, Storage storage) {
  if (mesh_ != nullptr) {
    return mesh_->smooth(xy, storage);
  }
  std::vector<Point2<double>> points = as_points(xy, topology_.vertex_count);
  const LocalFrame frame = local_frame(points, [&](std::size_t v) { return !hold::is_unused(fixed_[v]); });
  std::vector<Point2<double>> local(points.size());
  std::ranges::transform(points, local.begin(), [&](Point2<double> p) { return frame.enter(p); });
  Orientation orientation = orient(topology_, triangles_, local);
  if (smoother_ == nullptr || orientation.reversed != reversed_) {
    // It goes first: its memory is free for the next one, and if that cannot be made, nobody takes the old one for it.
    smoother_.reset();
    reversed_ = std::move(orientation.reversed);
    Workers workers(options_.threads);
    smoother_ =
        backend_of(options_).prepare(one_rings(topology_, triangles_, reversed_, fixed_, workers), local, options_);
  }
  const double fixed_quotient = options_.target_quality || options_.record_min_shape
                                    ? smallest_fixed_quotient(local, triangles_, reversed_, fixed_)
                                    : std::numeric_limits<double>::infinity();
  SmoothingResult result = smoother_->smooth(points, frame, storage, fixed_quotient);
  for (std::size_t v = 0; v < points.size(); ++v) {
    xy[2 * v] = points[v].x;
    xy[2 * v + 1] = points[v].y;
  }
  return result;
}

SmoothingPlan plan(std::int32_t vertex_count, std::span<const std::int32_t> triangles, const Constraints& constraints,
                   const SmoothingOptions& options) {
  return {vertex_count, triangles, constraints, options};
}

SmoothingResult smooth(std::span<double> xy, std::span<const std::int32_t> triangles, const Constraints& constraints,
                       const SmoothingOptions& options) {
  check_mesh_size(std::ssize(xy) / 2, std::ssize(triangles) / 3);
  return plan(static_cast<std::int32_t>(xy.size() / 2), triangles, constraints, options).smooth(xy);
}

}  // namespace trismooth

#include "trismooth/smoothing/smooth.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/smoothing/heights.h"
#include "trismooth/smoothing/rings/hold.h"
#include "trismooth/smoothing/rings/triangle_topology.h"

namespace trismooth {

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

class SmoothingPlan::Implementation {
 public:
  Implementation(std::int64_t vertex_count, const IndexView& indices, const Constraints& constraints,
                 const SmoothingOptions& options)
      : options_(checked(options)), workers_(options.threads) {
    check_mesh_size(vertex_count, static_cast<std::int64_t>(indices.size()));
    vertex_count_ = static_cast<std::int32_t>(vertex_count);
    const std::span<const Triangle> listed = indices.triangles(vertex_count, triangles_);
    if (options.topology == Topology::device) {
      mesh_ = backend_of(options).prepare_mesh(vertex_count_, listed, constraints, options);
      if (mesh_ != nullptr) {
        triangles_ = {};
        return;
      }
    }
    if (listed.data() != triangles_.data()) {
      triangles_.assign(listed.begin(), listed.end());
    }
    topology_ = connect_triangles(vertex_count_, triangles_, workers_);
    fixed_ = fixed_vertices(topology_, triangles_, constraints);
  }

  SmoothingResult smooth(const PointView& points, Storage storage) {
    require_a_point_a_vertex(points);
    const Storage stored = points.storage() == Storage::float32 ? Storage::float32 : storage;
    if (mesh_ != nullptr && !points.as_pairs().empty()) {
      return mesh_->smooth(points.as_pairs(), stored);
    }
    std::vector<Point2<double>> copy = points.read(workers_);
    if (points.components() == 3) {
      require_one_height(points, copy, [this] { return mesh_ != nullptr ? mesh_->fixed() : fixed_; });
    }
    SmoothingResult result = mesh_ != nullptr ? mesh_->smooth(copy, stored) : smooth_on_host(copy, stored);
    points.write(copy, workers_);
    return result;
  }

 private:
  static const SmoothingOptions& checked(const SmoothingOptions& options) {
    options.validate();
    return options;
  }

  void require_a_point_a_vertex(const PointView& points) const {
    const auto expected = static_cast<std::size_t>(vertex_count_);
    if (points.size() != expected) {
      const bool may_be_triples = points.components() == 2 && 2 * points.size() == 3 * expected;
      throw std::invalid_argument("points: " + std::to_string(points.size()) + " of them, expected one for each of " +
                                  std::to_string(expected) + " vertices" +
                                  (may_be_triples ? "; xyz_points() is for x, y and z" : ""));
    }
  }

  SmoothingResult smooth_on_host(std::vector<Point2<double>>& points, Storage storage) {
    const LocalFrame frame = local_frame(points, [&](std::size_t v) { return !hold::is_unused(fixed_[v]); });
    std::vector<Point2<double>> local(points.size());
    std::ranges::transform(points, local.begin(), [&](Point2<double> p) { return frame.enter(p); });
    Orientation orientation = orient(topology_, triangles_, local);
    if (smoother_ == nullptr || orientation.reversed != reversed_) {
      // It goes first: its memory is free for the next one, and if that cannot be made, nobody takes the old one for
      // it.
      smoother_.reset();
      reversed_ = std::move(orientation.reversed);
      smoother_ =
          backend_of(options_).prepare(one_rings(topology_, triangles_, reversed_, fixed_, workers_), local, options_);
    }
    const double fixed_quotient = options_.target_quality || options_.record_min_shape
                                      ? smallest_fixed_quotient(local, triangles_, reversed_, fixed_)
                                      : std::numeric_limits<double>::infinity();
    return smoother_->smooth(points, frame, storage, fixed_quotient);
  }

  SmoothingOptions options_;
  Workers workers_;
  std::int32_t vertex_count_ = 0;
  std::unique_ptr<PreparedMesh> mesh_;  ///< of a backend that analyses meshes itself; what follows is empty then
  std::vector<Triangle> triangles_;
  TriangleTopology topology_;
  std::vector<std::uint8_t> fixed_;
  std::vector<std::uint8_t> reversed_;
  std::unique_ptr<PreparedSmoother> smoother_;
};

SmoothingPlan::SmoothingPlan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints,
                             const SmoothingOptions& options)
    : implementation_(std::make_unique<Implementation>(vertex_count, triangles, constraints, options)) {}

SmoothingPlan::SmoothingPlan(SmoothingPlan&&) noexcept = default;
SmoothingPlan& SmoothingPlan::operator=(SmoothingPlan&&) noexcept = default;
SmoothingPlan::~SmoothingPlan() = default;

SmoothingResult SmoothingPlan::smooth(const PointView& points, Storage storage) {
  if (implementation_ == nullptr) {
    throw std::logic_error("this plan has been moved from");
  }
  return implementation_->smooth(points, storage);
}

SmoothingPlan plan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints,
                   const SmoothingOptions& options) {
  return {vertex_count, triangles, constraints, options};
}

SmoothingResult smooth(const PointView& points, const IndexView& triangles, const Constraints& constraints,
                       const SmoothingOptions& options) {
  return plan(static_cast<std::int64_t>(points.size()), triangles, constraints, options).smooth(points);
}

}  // namespace trismooth

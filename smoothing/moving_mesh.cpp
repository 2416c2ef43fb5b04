// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/moving_mesh.h"

#include <limits>
#include <utility>

#include "trismooth/base/heights.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/moved_from.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/follower.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/moving/mesh_at_rest.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

SmoothingOptions moving_options() {
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  options.mean_ratio.target = TargetShape::input;
  options.mean_ratio.power = 8;
  options.mean_ratio.size_weight = 0.3;
  options.mean_ratio.steady = true;
  options.max_sweeps = 1000;
  return options;
}

class MovingMesh::Implementation {
 public:
  Implementation(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
                 const SmoothingOptions& options)
      : options_(options_of_moving(options, constraints)),
        workers_(options.threads),
        mesh_(reference.read(workers_), triangles, constraints, options.layers, workers_, rings_),
        follower_(backend_of(options).follower(mesh_, std::move(rings_), options)) {}

  const SmoothingOptions& options() const { return options_; }
  const std::vector<std::uint8_t>& held() const { return mesh_.held(); }
  std::vector<Point2<double>> points() const { return follower_->points(); }

  void follow(const PointView& points, MovingStart start, FollowResult& result) {
    result.min_relative_shape = result.mean_relative_shape = std::numeric_limits<double>::quiet_NaN();
    require_a_point_a_vertex(points.size(), points.components(), std::ssize(held()));
    std::vector<Point2<double>> now = points.read(workers_);
    if (points.components() == 3) {
      // Where free vertices are means nothing.
      require_one_height(points, now, [this] { return mesh_.held_alone(); });
    }
    follower_->follow(now, points.storage(), start, result);
    result.smoothing.layers = mesh_.layers();
    if (result.smoothing.inverted >= 0) {
      points.write(now, workers_);
    }
  }

  void go_on_from(const ConstPointView& points) {
    require_a_point_a_vertex(points.size(), points.components(), std::ssize(held()));
    follower_->go_on_from(points.read(workers_));
  }

 private:
  SmoothingOptions options_;
  Workers workers_;
  MeshRings rings_;  ///< until the follower has them
  MeshAtRest mesh_;
  std::unique_ptr<Follower> follower_;
};

MovingMesh::MovingMesh(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
                       const SmoothingOptions& options)
    : implementation_(planned(
          options, [&] { return std::make_unique<Implementation>(reference, triangles, constraints, options); })) {}

MovingMesh::MovingMesh(const ConstPointView& reference, const IndexView& triangles, const SmoothingOptions& options)
    : MovingMesh(reference, triangles, Constraints{}, options) {}

MovingMesh::MovingMesh(MovingMesh&&) noexcept = default;
MovingMesh& MovingMesh::operator=(MovingMesh&&) noexcept = default;
MovingMesh::~MovingMesh() = default;

FollowResult MovingMesh::follow(const PointView& points, MovingStart start) {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  return followed(mesh.options(), backend_of(mesh.options()).name(),
                  [&](FollowResult& result) { mesh.follow(points, start, result); });
}

void MovingMesh::go_on_from(const ConstPointView& points) {
  not_moved_from(implementation_, "mesh").go_on_from(points);
}

std::vector<std::uint8_t> MovingMesh::held() const {
  return not_moved_from(implementation_, "mesh").held();
}

std::vector<Point2<double>> MovingMesh::points() const {
  return not_moved_from(implementation_, "mesh").points();
}

}  // namespace trismooth

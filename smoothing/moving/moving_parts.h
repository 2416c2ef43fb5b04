// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/smoothing/follow_result.h"
#include "trismooth/smoothing/moving/mesh_at_rest.h"

namespace trismooth {

/// What a MovingMesh holds, be its points in memory of the host or of a device: the mesh at rest, and a follower of
/// type F that leads it. Stays where it was made.
template <class F>
class MovingParts {
 public:
  /// `make(mesh, rings)` makes the follower, a std::unique_ptr<F>; the mesh outlives it. All else as MovingMesh's
  /// constructor.
  template <class Make>
  MovingParts(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
              const SmoothingOptions& options, const Make& make)
      : options_(options), workers_(options.threads) {
    MeshRings rings;
    mesh_ = std::make_unique<const MeshAtRest>(reference.read(workers_), triangles, constraints, options.layers,
                                               workers_, rings);
    follower_ = make(*mesh_, std::move(rings));
  }

  const SmoothingOptions& options() const { return options_; }
  Workers& workers() { return workers_; }
  const MeshAtRest& mesh() const { return *mesh_; }
  const std::vector<std::uint8_t>& held() const { return mesh_->held(); }
  std::vector<Point2<double>> points() const { return follower_->points(); }

  void go_on_from(const ConstPointView& points) {
    require_rest();
    require_a_point_a_vertex(points.size(), points.components(), std::ssize(held()));
    follower_->go_on_from(points.read(workers_));
    may_take_back_ = false;
  }

  void take_back() {
    require_rest();
    if (!std::exchange(may_take_back_, false)) {
      throw std::logic_error("there is no step to take back");
    }
    follower_->take_back();
  }

  /// MovingMesh::follow(): calls prepare(), which may refuse what the caller has given, and then
  /// follow(follower, result).
  template <class Prepare, class Follow>
  void follow(FollowResult& result, const Prepare& prepare, const Follow& follow) {
    require_rest();
    struct Work {
      explicit Work(bool& flag) : is_at_work(flag) { is_at_work = true; }
      Work(const Work&) = delete;
      Work& operator=(const Work&) = delete;
      ~Work() { is_at_work = false; }
      bool& is_at_work;
    };
    const Work work(is_at_work_);
    result.min_relative_shape = result.mean_relative_shape = std::numeric_limits<double>::quiet_NaN();
    prepare();
    may_take_back_ = false;
    follow(*follower_, result);
    result.smoothing.layers = mesh_->layers();
    may_take_back_ = result.smoothing.inverted >= 0;
  }

 private:
  void require_rest() const {
    if (is_at_work_) {
      throw std::logic_error("this mesh is at work, and cannot be used by what it calls");
    }
  }

  SmoothingOptions options_;
  Workers workers_;
  std::unique_ptr<const MeshAtRest> mesh_;
  std::unique_ptr<F> follower_;
  bool may_take_back_ = false;
  bool is_at_work_ = false;
};

}  // namespace trismooth

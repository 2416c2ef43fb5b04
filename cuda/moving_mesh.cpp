// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/moving_mesh.h"

#include <cstddef>
#include <limits>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/moved_from.h"
#include "trismooth/cuda/device_follower.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/runtime/device_pointer.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/moving/mesh_at_rest.h"

namespace trismooth::cuda {

class MovingMesh::Implementation {
 public:
  Implementation(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
                 const SmoothingOptions& options, cudaStream_t stream)
      : options_(options),
        workers_(options.threads),
        mesh_(reference.read(workers_), triangles, constraints, options.layers, workers_, rings_),
        follower_(mesh_, std::exchange(rings_, {}), options, stream) {}

  const SmoothingOptions& options() const { return options_; }
  const std::vector<std::uint8_t>& held() const { return mesh_.held(); }
  std::vector<Point2<double>> points() const { return follower_.points(); }

  template <class T>
  void follow(T* xy, Storage storage, MovingStart start, FollowResult& result) {
    result.min_relative_shape = result.mean_relative_shape = std::numeric_limits<double>::quiet_NaN();
    require_aligned(xy, held().size(), sizeof(Point2<T>), "xy");
    require_on_device(xy, held().size(), "xy");
    follower_.follow_on_device(xy, storage, start, result);
    result.smoothing.layers = mesh_.layers();
  }

  void go_on_from(const ConstPointView& points) {
    require_a_point_a_vertex(points.size(), points.components(), std::ssize(held()));
    follower_.go_on_from(points.read(workers_));
  }

 private:
  SmoothingOptions options_;
  Workers workers_;
  MeshRings rings_;  ///< until the follower has them
  MeshAtRest mesh_;
  DeviceFollower follower_;
};

MovingMesh::MovingMesh(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
                       const SmoothingOptions& options, cudaStream_t stream) {
  options_of_moving(options, constraints);
  require_device();
  implementation_ = planned(
      options, [&] { return std::make_unique<Implementation>(reference, triangles, constraints, options, stream); });
}

MovingMesh::MovingMesh(MovingMesh&&) noexcept = default;
MovingMesh& MovingMesh::operator=(MovingMesh&&) noexcept = default;
MovingMesh::~MovingMesh() = default;

FollowResult MovingMesh::follow(double* xy, MovingStart start, Storage storage) {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  return followed(mesh.options(), "cuda", [&](FollowResult& result) { mesh.follow(xy, storage, start, result); });
}

FollowResult MovingMesh::follow(float* xy, MovingStart start) {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  return followed(mesh.options(), "cuda",
                  [&](FollowResult& result) { mesh.follow(xy, Storage::float32, start, result); });
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

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/moving_mesh.h"

#include <stdexcept>

#include "trismooth/base/moved_from.h"
#include "trismooth/cuda/device_follower.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/runtime/device_pointer.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/moving/moving_parts.h"

namespace trismooth::cuda {

class MovingMesh::Implementation : public MovingParts<DeviceFollower> {
 public:
  Implementation(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
                 const SmoothingOptions& options, cudaStream_t stream)
      : MovingParts(reference, triangles, constraints, options, [&](const MeshAtRest& mesh, const MeshRings& rings) {
          return std::make_unique<DeviceFollower>(mesh, rings, options, stream);
        }) {}

  template <class T>
  void follow(T* xy, Storage storage, MovingStart start, FollowResult& result) {
    const auto look = [&] {
      require_aligned(xy, held().size(), sizeof(Point2<T>), "xy");
      require_on_device(xy, held().size(), "xy");
    };
    MovingParts::follow(result, look, [&](DeviceFollower& follower, FollowResult& found) {
      follower.follow_on_device(xy, storage, start, found);
    });
  }
};

MovingMesh::MovingMesh(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
                       const SmoothingOptions& options, cudaStream_t stream) {
  options_of_moving(options, constraints);
  if (triangles.may_have_quadrilaterals()) {
    throw std::invalid_argument(
        "triangles: four vertex numbers each; points in device memory follow as triangles alone, of which there are "
        "three, and with quadrilaterals in memory of the host");
  }
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

void MovingMesh::take_back() {
  not_moved_from(implementation_, "mesh").take_back();
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

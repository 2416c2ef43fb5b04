// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/moving_mesh.h"

#include <iterator>
#include <utility>

#include "trismooth/base/heights.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/moved_from.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/follower.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/moving/moving_parts.h"
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

class MovingMesh::Implementation : public MovingParts<Follower> {
 public:
  Implementation(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
                 const SmoothingOptions& options)
      : MovingParts(reference, triangles, constraints, options_of_moving(options, constraints),
                    [&](const MeshAtRest& mesh, MeshRings rings) {
                      return backend_of(options).follower(mesh, std::move(rings), options);
                    }) {}

  void follow(const PointView& points, MovingStart start, Storage storage, FollowResult& result) {
    std::vector<Point2<double>> now;
    const auto read = [&] {
      require_a_point_a_vertex(points.size(), points.components(), std::ssize(held()));
      now = points.read(workers());
      if (points.components() == 3) {
        // Where free vertices are means nothing.
        require_one_height(points, now, [this] { return mesh().held_alone(); });
      }
    };
    MovingParts::follow(result, read, [&](Follower& follower, FollowResult& found) {
      follower.follow(now, points.storage() == Storage::float32 ? Storage::float32 : storage, start, found);
      if (found.smoothing.inverted >= 0) {
        points.write(now, workers());
      }
    });
  }
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

FollowResult MovingMesh::follow(const PointView& points, MovingStart start, Storage storage) {
  Implementation& mesh = not_moved_from(implementation_, "mesh");
  return followed(mesh.options(), backend_of(mesh.options()).name(),
                  [&](FollowResult& result) { mesh.follow(points, start, storage, result); });
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

}  // namespace trismooth

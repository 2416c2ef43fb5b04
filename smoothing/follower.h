// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/moving/mesh_at_rest.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// What follow(FollowResult&) says; where time is up before the first sweep, what is known by then.
template <class Follow>
FollowResult followed(const SmoothingOptions& options, const std::string& backend, const Follow& follow) {
  FollowResult result;
  const SmoothingResult ended = limited(options, backend, [&] {
    follow(result);
    return SmoothingResult{};
  });
  if (ended.inverted < 0) {
    result.smoothing = ended;
  }
  return result;
}

/// What has a mesh at rest follow its boundary: on the host, on a device, to the same bits. Owns all it needs.
class Follower {
 public:
  Follower() = default;
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  virtual ~Follower() = default;

  /// MovingMesh::follow(), of points in memory of the host that are finite, in place. `result` has what was found out
  /// where the call is over before the first sweep, too; the points are untouched then.
  virtual void follow(std::span<Point2<double>> points, Storage storage, MovingStart start, FollowResult& result) = 0;

  /// The last result, of a follow() that has come to its end, is the one before it again. Called once after each.
  virtual void take_back() = 0;
  /// Has these be the last result.
  virtual void go_on_from(std::vector<Point2<double>> points) = 0;
  /// The last result.
  virtual std::vector<Point2<double>> points() const = 0;
};

/// Carries the mesh, which outlives it, along on the host; `smoother` has been made of its rings, and does the rest.
/// Throws as PreparedSmoother::aim_at().
std::unique_ptr<Follower> host_follower(const MeshAtRest& mesh, std::unique_ptr<PreparedSmoother> smoother,
                                        const SmoothingOptions& options);

}  // namespace trismooth

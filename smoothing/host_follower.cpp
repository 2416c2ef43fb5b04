// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/follower.h"
#include "trismooth/smoothing/invalid_triangles.h"
#include "trismooth/smoothing/moving/carry.h"
#include "trismooth/smoothing/moving/mesh_at_rest.h"
#include "trismooth/smoothing/moving/overlaps.h"
#include "trismooth/smoothing/moving/relative_shape.h"
#include "trismooth/smoothing/systems/host_rows.h"

namespace trismooth {

namespace {

class HostFollower final : public Follower {
 public:
  HostFollower(const MeshAtRest& mesh, std::unique_ptr<PreparedSmoother> smoother, const SmoothingOptions& options)
      : mesh_(mesh),
        options_(options),
        workers_(options.threads),
        held_alone_(mesh.held_alone()),
        smoother_(std::move(smoother)),
        previous_(mesh.points()) {}

  void follow(std::span<Point2<double>> points, Storage storage, MovingStart start, FollowResult& result) override {
    std::vector<Point2<double>> now = std::move(other_);
    now.assign(points.begin(), points.end());
    {
      // Without the free vertices carried along there is no mesh to end with.
      const CallLimit patient(std::numeric_limits<double>::infinity(), *CallLimit::current());
      const LocalPoints held = in_frame_of(now, held_alone_);
      mesh_.find_crossings(mesh_.of_held(held.points), result);
      carry_from(start == MovingStart::reference ? mesh_.points() : previous_, storage, held, now);
    }
    const LocalFrame frame = local_frame_of_cells(now, mesh_.held());
    result.smoothing = smoother_->smooth(now, storage, frame);
    if (result.smoothing.inverted < 0) {
      return;
    }
    look_at(now, frame, result);
    std::ranges::copy(now, points.begin());
    other_ = std::exchange(previous_, std::move(now));
  }

  void take_back() override { std::swap(previous_, other_); }

  void go_on_from(std::vector<Point2<double>> points) override { previous_ = std::move(points); }
  std::vector<Point2<double>> points() const override { return previous_; }

 private:
  static constexpr std::int64_t grain = 8192;

  /// The points in the frame of those that are in use.
  LocalPoints in_frame_of(std::span<const Point2<double>> points, const std::vector<std::uint8_t>& held) {
    return local_points(
        points, [&held](std::size_t v) { return !hold::is_unused(held[v]); }, workers_);
  }

  /// Calls body(i) for 0 <= i < count, on all workers.
  template <class Body>
  void for_all(std::int64_t count, const Body& body) {
    workers_.for_blocks(count, grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        body(i);
      }
    });
  }

  /// Puts the free vertices of `now` to where they are carried from `from`. `held`: all of `now` in the frame of those
  /// that are held.
  void carry_from(std::span<const Point2<double>> from, Storage storage, const LocalPoints& held,
                  std::vector<Point2<double>>& now) {
    BulkVector<Point2<double>> places = held.points;
    LocalPoints was = in_frame_of(from, mesh_.held());
    for_all(std::ssize(was.points),
            [&](std::int64_t v) { was.points[v] = rescaled(was.points[v], was.frame.exponent - held.frame.exponent); });
    const Carrier& carrier = mesh_.carrier();
    const HeldMotion motion = carrier.motion_of_held(mesh_.of_held(was.points), mesh_.of_held(places));
    const std::vector<LevelView> levels = carrier.laplacian().view();
    HostRows rows(workers_);
    carry(carrier.view(levels), motion.all, motion.turns.data(), was.points.data(), places.data(), rows);
    for_all(std::ssize(now), [&](std::int64_t v) {
      now[v] =
          mesh_.held()[v] == 0 ? rounded_to(storage, from[v]) : now[v];  // of what hangs together with nothing held
    });
    for_all(std::ssize(carrier.carried()), [&](std::int64_t i) {
      const std::int32_t v = carrier.carried()[i];
      now[v] = rounded_to(storage, held.frame.leave(finite_or_zero(places[v]), largest_stored(storage)));
    });
  }

  /// Fills in what the result says of the mesh.
  void look_at(std::span<const Point2<double>> now, const LocalFrame& frame, FollowResult& result) {
    const BulkVector<Point2<double>> places = entered(frame, now).points;
    // What the untangling has turned over is inverted as the reference orients it.
    std::vector<std::uint8_t> turned;
    if (result.smoothing.untangling) {
      turned.swap(result.smoothing.untangling->turned);
    }
    mesh_.elements().visit([&](const auto& listed) {
      count_invalid(
          listed, mesh_.reversed(), [&](std::int32_t v) { return places[v]; }, workers_, result.smoothing);
    });
    result.smoothing.quadrilaterals = mesh_.elements().count_quadrilaterals();
    if (result.smoothing.untangling) {
      turned.swap(result.smoothing.untangling->turned);
    }
    mesh_.list_overlaps(overlapping_vertices(mesh_.elements(), mesh_.reversed(), mesh_.held(), places, workers_),
                        result);
    if (result.smoothing.inverted + result.smoothing.degenerate > 0) {
      mesh_.list_invalid(places, result);
    }
    struct Shapes {
      double sum = 0;
      RelativeShapes of_all = RelativeShapes::none();
      Shapes& operator+=(const Shapes& other) {
        sum += other.sum;
        of_all += other.of_all;
        return *this;
      }
    };
    const Shapes shapes = mesh_.elements().visit([&](const auto& listed) {
      return ordered_sum(
          listed.size(),
          [&](std::size_t e) {
            Shapes one;
            one.of_all = relative_shapes(canonical_corners(listed[e], mesh_.reversed()[e] != 0), mesh_.held(),
                                         mesh_.local().points, places, one.sum);
            return one;
          },
          workers_);
    });
    tell(shapes.of_all, shapes.sum, result);
    result.largest_move = joined_blocks(
        std::ssize(now), grain, workers_, 0.0,
        [&](std::int64_t begin, std::int64_t end, double& largest) {
          for (std::int64_t v = begin; v < end; ++v) {
            largest = std::max(largest, length_of_move(previous_[v], now[v], frame.exponent));
          }
        },
        [](double& largest, double one) { largest = std::max(largest, one); });
  }

  const MeshAtRest& mesh_;
  const SmoothingOptions options_;
  Workers workers_;
  std::vector<std::uint8_t> held_alone_;
  std::unique_ptr<PreparedSmoother> smoother_;
  std::vector<Point2<double>> previous_;
  std::vector<Point2<double>> other_;  ///< the result before the last one
};

}  // namespace

std::unique_ptr<Follower> host_follower(const MeshAtRest& mesh, std::unique_ptr<PreparedSmoother> smoother,
                                        const SmoothingOptions& options) {
  smoother->aim_at(mesh.points(), mesh.local().frame);
  return std::make_unique<HostFollower>(mesh, std::move(smoother), options);
}

std::unique_ptr<Follower> Backend::follower(const MeshAtRest& mesh, MeshRings rings,
                                            const SmoothingOptions& options) const {
  return host_follower(mesh, prepare(std::move(rings), mesh.elements(), mesh.local().points, options), options);
}

}  // namespace trismooth

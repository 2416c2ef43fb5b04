#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/sweeps/gathered_ring.h"
#include "trismooth/smoothing/sweeps/lane_update.h"

namespace trismooth {

/// Visits of a method to vertices, many of them side by side: see RingLanes. What lanes cannot tell is asked for alone.
template <class T, class Method>
class VertexVisits {
 public:
  VertexVisits(const Method& method, const RingView& rings, std::span<const Point2<T>> points)
      : method_(method), rings_(rings), points_(points) {}

  /// Calls settle(v, target, squares) for those of `vertices`, whose rings are of one size, that move.
  template <class Settle>
  void visit(std::span<const std::int32_t> vertices, int ring_size, const Settle& settle) {
    while (!vertices.empty()) {
      const auto group = vertices.first(std::min<std::size_t>(RingLanes<T>::lanes, vertices.size()));
      vertices = vertices.subspan(group.size());
      if (RingLanes<T>::holds(ring_size)) {
        visit_in_lanes(group, ring_size, settle);
      } else {
        for (const std::int32_t v : group) {
          visit_alone(v, settle);
        }
      }
    }
  }

 private:
  template <class Settle>
  void visit_in_lanes(std::span<const std::int32_t> group, int ring_size, const Settle& settle) {
    const int count = static_cast<int>(group.size());
    for (int lane = 0; lane < count; ++lane) {
      take(group[lane], ring_size, lane);
    }
    update_(ring_size, count, lanes_);
    // Who moves is listed first, without branches: about half of them would be guessed wrong.
    std::array<int, RingLanes<T>::lanes> moving{};
    int movers = 0;
    bool are_decided = true;
    for (int lane = 0; lane < count; ++lane) {
      const bool is_decided = lanes_.undecided[lane] == T(0);
      are_decided &= is_decided;
      moving[movers] = lane;
      movers += (is_decided & (lanes_.moves[lane] != T(0))) ? 1 : 0;
    }
    for (int i = 0; i < movers; ++i) {
      const int lane = moving[i];
      settle(group[lane], Point2<T>{lanes_.target_x[lane], lanes_.target_y[lane]}, lanes_.squares[lane]);
    }
    for (int lane = 0; lane < count && !are_decided; ++lane) {
      if (lanes_.undecided[lane] != T(0)) {
        visit_alone(group[lane], settle);
      }
    }
  }

  void take(std::int32_t v, int ring_size, int lane) {
    const std::int32_t* const ring = rings_[v].data();
    for (int i = 0; i < ring_size; ++i) {
      const Point2<T> neighbour = points_[ring[i]];
      lanes_.x[i][lane] = neighbour.x;
      lanes_.y[i][lane] = neighbour.y;
    }
    lanes_.position_x[lane] = points_[v].x;
    lanes_.position_y[lane] = points_[v].y;
  }

  template <class Settle>
  void visit_alone(std::int32_t v, const Settle& settle) {
    const VertexMove<T> result = gatherer_.with_ring_of_any_size(
        points_, rings_[v], [&](const auto& ring) { return update_over(method_, v, points_[v], ring); });
    if (result.move.moved) {
      settle(v, result.move.position, result.squares);
    }
  }

  RingLanes<T> lanes_;
  const Method& method_;
  const RingView& rings_;
  std::span<const Point2<T>> points_;
  LaneUpdate<T> update_ = lane_update<Method, T>(instruction_set());
  RingGatherer<T> gatherer_;
};

}  // namespace trismooth

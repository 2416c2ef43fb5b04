// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/sweeps/gathered_ring.h"
#include "trismooth/smoothing/sweeps/lane_update.h"
#include "trismooth/smoothing/sweeps/lanes.h"
#include "trismooth/smoothing/sweeps/proposed_update.h"

namespace trismooth {

/// What a method says of vertices side by side, and for which rings it can. Specialised for methods that need more than
/// the positions of a ring: see mean_ratio_lanes.h.
template <class T, class Method>
class SideBySide {
 public:
  SideBySide(const Method& /*method*/, const RingView& rings, std::span<const Point2<T>> points)
      : rings_(rings), points_(points) {}

  static constexpr bool holds(int ring_size, RingKind kind) { return RingLanes<T>::holds(ring_size, kind); }

  /// Of the first `count` of `vertices`; the others come next.
  const LaneMoves<T>& moves(std::span<const std::int32_t> vertices, int count, int ring_size, RingKind kind) {
    for (int lane = 0; lane < count; lane += together) {
      Numbers own;
      for (int k = 0; k < together; ++k) {
        own[k] = vertices[lane + k < count ? lane + k : lane];
      }
      put(own, &lanes_.position_x[lane], &lanes_.position_y[lane]);
      take(rings_.neighbours, own, ring_size, 0, lane);
      if (needs_opposites && kind == RingKind::quadrilaterals) {
        take(rings_.opposites, own, ring_size, ring_size, lane);
      }
    }
    update_(ring_size, kind, count, lanes_);
    return lanes_;
  }

 private:
  /// Who only goes to a mean of the neighbours looks at no element.
  static constexpr bool needs_opposites = Method::is_smart;

  /// So many points at a time are turned into lanes in registers of 16 bytes, which every processor has: number by
  /// number takes a tenth longer for the whole update.
  static constexpr int together = LanesOf<T, 16>::count;
  using Numbers = std::array<std::int32_t, together>;

  /// Takes so many vertices of the rings of `own` as those from `place` on. `rings`: neighbours or opposites.
  void take(std::span<const std::int32_t> rings, const Numbers& own, int count, int place, int lane) {
    std::array<const std::int32_t*, together> ring;
    for (int k = 0; k < together; ++k) {
      ring[k] = rings.data() + rings_.offsets[own[k]];
    }
    for (int i = 0; i < count; ++i) {
      Numbers numbers;
      for (int k = 0; k < together; ++k) {
        numbers[k] = ring[k][i];
      }
      put(numbers, &lanes_.x[place + i][lane], &lanes_.y[place + i][lane]);
    }
  }

  /// Their points, from these places of lanes on.
  void put(const Numbers& numbers, T* x, T* y) {
    using Register = Lanes<T, 16>;
    std::array<Register, 2> gathered;
    for (int k = 0; k < together; ++k) {
      std::memcpy(reinterpret_cast<Point2<T>*>(gathered.data()) + k, &points_[numbers[k]], sizeof(Point2<T>));
    }
    Register xs;
    Register ys;
    if constexpr (together == 2) {
      xs = __builtin_shufflevector(gathered[0], gathered[1], 0, 2);
      ys = __builtin_shufflevector(gathered[0], gathered[1], 1, 3);
    } else {
      xs = __builtin_shufflevector(gathered[0], gathered[1], 0, 2, 4, 6);
      ys = __builtin_shufflevector(gathered[0], gathered[1], 1, 3, 5, 7);
    }
    std::memcpy(x, &xs, sizeof xs);
    std::memcpy(y, &ys, sizeof ys);
  }

  RingLanes<T> lanes_;
  const RingView& rings_;
  std::span<const Point2<T>> points_;
  LaneUpdate<T> update_ = lane_update<T>(Method::method, instruction_set());
};

/// Of the caller's own method a vertex at a time.
template <class T>
class SideBySide<T, ProposedUpdate<T>> {
 public:
  SideBySide(const ProposedUpdate<T>& /*method*/, const RingView& /*rings*/, std::span<const Point2<T>> /*points*/) {}

  static constexpr bool holds(int /*ring_size*/, RingKind /*kind*/) { return false; }
};

/// Visits of a method to vertices, many of them side by side. What lanes cannot tell is asked for alone.
template <class T, class Method>
class VertexVisits {
 public:
  VertexVisits(const Method& method, const RingView& rings, std::span<const Point2<T>> points)
      : side_by_side_(method, rings, points), method_(method), rings_(rings), points_(points) {}

  /// Calls settle(v, target, squares) for those of `vertices`, whose rings are of one size and kind, that move. They
  /// share no element, or settle() leaves the points as they are.
  template <class Settle>
  void visit(std::span<const std::int32_t> vertices, int ring_size, RingKind kind, const Settle& settle) {
    if (!side_by_side_.holds(ring_size, kind)) {
      for (const std::int32_t v : vertices) {
        visit_alone(v, settle);
      }
      return;
    }
    if constexpr (requires { side_by_side_.moves(vertices, 1, ring_size, kind); }) {
      while (!vertices.empty()) {
        const int count = static_cast<int>(std::min<std::size_t>(LaneMoves<T>::lanes, vertices.size()));
        visit_in_lanes(vertices, count, ring_size, kind, settle);
        vertices = vertices.subspan(static_cast<std::size_t>(count));
      }
    }
  }

 private:
  template <class Settle>
  void visit_in_lanes(std::span<const std::int32_t> vertices, int count, int ring_size, RingKind kind,
                      const Settle& settle) {
    const LaneMoves<T>& found = side_by_side_.moves(vertices, count, ring_size, kind);
    // Who moves is listed first, without branches: about half of them would be guessed wrong.
    std::array<int, LaneMoves<T>::lanes> moving{};
    int movers = 0;
    bool are_decided = true;
    for (int lane = 0; lane < count; ++lane) {
      const bool is_decided = found.undecided[lane] == T(0);
      are_decided &= is_decided;
      moving[movers] = lane;
      movers += (is_decided & (found.moves[lane] != T(0))) ? 1 : 0;
    }
    for (int i = 0; i < movers; ++i) {
      const int lane = moving[i];
      settle(vertices[lane], Point2<T>{found.target_x[lane], found.target_y[lane]}, found.squares[lane]);
    }
    for (int lane = 0; lane < count && !are_decided; ++lane) {
      if (found.undecided[lane] != T(0)) {
        visit_alone(vertices[lane], settle);
      }
    }
  }

  template <class Settle>
  void visit_alone(std::int32_t v, const Settle& settle) {
    const VertexMove<T> result = move_alone(v);
    if (result.move.moved) {
      settle(v, result.move.position, result.squares);
    }
  }

  /// Compiled once, whoever asks for everything to be inlined: few vertices come here.
  [[gnu::noinline]] VertexMove<T> move_alone(std::int32_t v) {
    return gatherer_.visit(points_, rings_, v,
                           [&](const auto& ring) { return update_over(method_, v, points_[v], ring); });
  }

  SideBySide<T, Method> side_by_side_;
  const Method& method_;
  const RingView& rings_;
  std::span<const Point2<T>> points_;
  RingGatherer<T> gatherer_;
};

}  // namespace trismooth

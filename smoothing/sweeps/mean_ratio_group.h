// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/sweeps/lanes.h"
#include "trismooth/smoothing/sweeps/mean_ratio_lanes.h"
#include "trismooth/smoothing/sweeps/ring_lanes.h"
#include "trismooth/smoothing/sweeps/sides_in_lanes.h"

namespace trismooth {

/// What the mean-ratio method says of vertices in the lanes of registers of so many bytes, in rings of triangles or of
/// quadrilaterals: `Corner`.
template <class T, bool shaped, bool is_last, int bytes, template <class> class Corner>
class MeanRatioGroup {
 public:
  using Method = MeanRatio<T, shaped, is_last>;

  MeanRatioGroup(const Method& method, const RingView& rings, const Point2<T>* points, int ring_size)
      : method_(method),
        rings_(rings),
        points_(points),
        inverse_areas_(method.targets().inverse_areas),
        ring_size_(ring_size) {}

  /// See MeanRatioLanes.
  void find(std::span<const std::int32_t> vertices, int count, LaneMoves<T>& found) {
    const int all = static_cast<int>(vertices.size());
    for (int begin = 0; begin < count; begin += lanes) {
      const int next = begin + lanes;
      for (int i = next; i < next + lanes && i < all; ++i) {
        prefetch_ring(vertices[i]);
      }
      std::array<std::int32_t, lanes> group;
      for (int lane = 0; lane < lanes; ++lane) {
        group[lane] = vertices[begin + lane < count ? begin + lane : begin];
      }
      find_group(group, begin, found);
    }
  }

 private:
  static constexpr int lanes = LanesOf<T, bytes>::count;
  using V = Lanes<T, bytes>;
  using Mask = typename NewtonMove<V>::Mask;
  using Metric = typename Method::template Metric<V>;
  using Sides = SidesInLanes<T, bytes, Metric, Corner>;

  void find_group(const std::array<std::int32_t, lanes>& vertices, int begin, LaneMoves<T>& found) {
    take_sides(vertices);
    const Point2<V> positions = positions_of([&](int lane) { return vertices[lane]; });
    const V largest = join([&](int lane) { return method_.targets().largest_shares[vertices[lane]]; });
    Mask alone{};
    const NewtonMove<V> move = method_.newton_move(sides_, positions, largest, [&](const Mask& may_grow, Point2<V>) {
      alone = alone || may_grow;
      return may_grow;
    });
    alone = alone || !move.is_valid;
    const Point2<V> target = move.target;
    const Mask moves = move.moved && is_move(positions, target);
    const V one = V{} + T(1);
    put(target.x, &found.target_x[begin]);
    put(target.y, &found.target_y[begin]);
    put(move.squares, &found.squares[begin]);
    put(moves ? one : V{}, &found.moves[begin]);
    put(alone ? one : V{}, &found.undecided[begin]);
  }

  static void put(V numbers, T* to) { __builtin_memcpy(to, &numbers, sizeof numbers); }

  /// Asks for what is read of a ring's neighbours before they are needed: on large meshes waiting for them is a third
  /// of the time. Inlined by force: GCC drops calls of a function that only prefetches, since it returns nothing and
  /// stores nothing.
  [[gnu::always_inline]] void prefetch_ring(std::int32_t v) const {
    const auto ask_for = [this](std::span<const std::int32_t> vertices) {
      for (const std::int32_t vertex : vertices) {
        __builtin_prefetch(&points_[vertex]);
        __builtin_prefetch(&inverse_areas_[vertex]);
      }
    };
    ask_for(rings_[v]);
    if constexpr (Sides::has_opposites) {
      ask_for(rings_.mixed(v).opposites);
    }
  }

  void take_sides(const std::array<std::int32_t, lanes>& vertices) {
    // What is neighbour i, or behind the neighbours an opposite vertex, in a lane.
    std::array<const std::int32_t*, lanes> neighbours{};
    std::array<const std::int32_t*, lanes> opposites{};
    for (int lane = 0; lane < lanes; ++lane) {
      neighbours[lane] = rings_[vertices[lane]].data();
      if constexpr (Sides::has_opposites) {
        opposites[lane] = rings_.mixed(vertices[lane]).opposites.data() - ring_size_;
      }
    }
    const auto number = [&](int lane, int i) {
      return Sides::has_opposites && i >= ring_size_ ? opposites[lane][i] : neighbours[lane][i];
    };
    sides_.take(
        ring_size_, join([&](int lane) { return inverse_areas_[vertices[lane]]; }),
        [&](int i) -> typename Sides::Neighbour {
          return {positions_of([&](int lane) { return number(lane, i); }),
                  join([&](int lane) { return inverse_areas_[number(lane, i)]; })};
        },
        [&](const auto& corner) {
          return metrics([&](int lane) {
            return method_.metric(vertices[lane], corner.with([&](int i) { return number(lane, i); }));
          });
        });
  }

  /// Those of the vertices number(lane).
  template <class Number>
  Point2<V> positions_of(const Number& number) const {
    return {join([&](int lane) { return points_[number(lane)].x; }),
            join([&](int lane) { return points_[number(lane)].y; })};
  }

  template <class MetricIn>
  static Metric metrics(const MetricIn& metric_in) {
    if constexpr (shaped) {
      std::array<EdgeTensor<T>, lanes> one;
      for (int lane = 0; lane < lanes; ++lane) {
        one[lane] = metric_in(lane);
      }
      return {join([&](int lane) { return one[lane].xx; }), join([&](int lane) { return one[lane].xy; }),
              join([&](int lane) { return one[lane].yy; })};
    } else {
      return {};
    }
  }

  template <class Number>
  static V join(const Number& number) {
    return joined<T, bytes>(number);
  }

  const Method& method_;
  const RingView& rings_;
  const Point2<T>* points_;
  const T* inverse_areas_;
  int ring_size_;
  Sides sides_;
};

/// All of that, a function for each of the methods. Everything in it is inlined, by force; and it is its source's own,
/// whose instructions others may not have.
template <class T, bool shaped, bool is_last, int bytes>
[[gnu::flatten]] static void find_in_lanes(const MeanRatio<T, shaped, is_last>& method, const RingView& rings,
                                           const Point2<T>* points, std::span<const std::int32_t> vertices, int count,
                                           int ring_size, RingKind kind, LaneMoves<T>& found) {
  if (kind == RingKind::triangles) {
    MeanRatioGroup<T, shaped, is_last, bytes, TriangleCorner>(method, rings, points, ring_size)
        .find(vertices, count, found);
  } else {
    MeanRatioGroup<T, shaped, is_last, bytes, QuadrilateralCorner>(method, rings, points, ring_size)
        .find(vertices, count, found);
  }
}

}  // namespace trismooth

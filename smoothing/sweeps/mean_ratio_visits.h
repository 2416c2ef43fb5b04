#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/sweeps/lanes.h"
#include "trismooth/smoothing/sweeps/sides_in_lanes.h"
#include "trismooth/smoothing/sweeps/vertex_visits.h"

namespace trismooth {

/// Visits of the mean-ratio method, to a vertex in each lane of a register. The few that its energy alone does not
/// decide are made again one after the other.
template <class T, bool shaped, bool is_last>
class VertexVisits<T, MeanRatio<T, shaped, is_last>> {
 public:
  using Method = MeanRatio<T, shaped, is_last>;

  VertexVisits(const Method& method, const RingView& rings, std::span<const Point2<T>> points)
      : method_(method), rings_(rings), points_(points), inverse_areas_(method.targets().inverse_areas) {}

  /// Calls settle(v, target, squares) for those of `vertices`, whose rings are of one size, that move. They share no
  /// edge, or settle() leaves the points as they are.
  template <class Settle>
  void visit(std::span<const std::int32_t> vertices, int ring_size, const Settle& settle) {
    while (!vertices.empty()) {
      const auto group = vertices.first(std::min<std::size_t>(lanes, vertices.size()));
      vertices = vertices.subspan(group.size());
      for (const std::int32_t v : vertices.first(std::min<std::size_t>(lanes, vertices.size()))) {
        prefetch_ring(v);
      }
      visit_group(group, ring_size, settle);
    }
  }

 private:
  static constexpr int lanes = LanesOf<T>::count;
  using V = Lanes<T>;
  using Mask = typename NewtonMove<V>::Mask;
  using Metric = typename Method::template Metric<V>;

  template <class Settle>
  void visit_group(std::span<const std::int32_t> group, int ring_size, const Settle& settle) {
    std::array<std::int32_t, lanes> vertices;
    vertices.fill(group[0]);
    std::ranges::copy(group, vertices.begin());
    take_sides(vertices, ring_size);
    const Point2<V> positions = positions_of([&](int lane) { return vertices[lane]; });
    const V largest = joined<T>([&](int lane) { return method_.targets().largest_shares[vertices[lane]]; });
    Mask alone{};
    const NewtonMove<V> found = method_.newton_move(sides_, positions, largest, [&](const Mask& may_grow, Point2<V>) {
      alone = alone || may_grow;
      return may_grow;
    });
    alone = alone || !found.is_valid;
    for (int lane = 0; lane < static_cast<int>(group.size()); ++lane) {
      const std::int32_t v = vertices[lane];
      const Point2<T> position = points_[v];
      const Point2<T> target{found.target.x[lane], found.target.y[lane]};
      if (alone[lane]) {
        visit_alone(v, settle);
      } else if (found.moved[lane] && move_to(position, target).moved) {
        settle(v, target, found.squares[lane]);
      }
    }
  }

  template <class Settle>
  void visit_alone(std::int32_t v, const Settle& settle) {
    const VertexMove<T> result = gatherer_.with_ring_of_any_size(
        points_, rings_[v], [&](const auto& ring) { return method_.vertex_move(v, points_[v], ring); });
    if (result.move.moved) {
      settle(v, result.move.position, result.squares);
    }
  }

  /// Asks for what is read of a ring's neighbours before they are needed: on large meshes waiting for them is a third
  /// of the time. Inlined by force: GCC drops calls of a function that only prefetches, since it returns nothing and
  /// stores nothing.
  [[gnu::always_inline]] void prefetch_ring(std::int32_t v) const {
    for (const std::int32_t neighbour : rings_[v]) {
      __builtin_prefetch(&points_[neighbour]);
      __builtin_prefetch(&inverse_areas_[neighbour]);
    }
  }

  void take_sides(const std::array<std::int32_t, lanes>& vertices, int size) {
    std::array<const std::int32_t*, lanes> rings{};
    for (int lane = 0; lane < lanes; ++lane) {
      rings[lane] = rings_[vertices[lane]].data();
    }
    sides_.take(
        size, joined<T>([&](int lane) { return inverse_areas_[vertices[lane]]; }),
        [&](int i) -> typename SidesInLanes<T, Metric>::Neighbour {
          return {positions_of([&](int lane) { return rings[lane][i]; }),
                  joined<T>([&](int lane) { return inverse_areas_[rings[lane][i]]; })};
        },
        [&](int i) {
          const int following = i + 1 < size ? i + 1 : 0;
          return metrics(
              [&](int lane) { return method_.metric(vertices[lane], rings[lane][i], rings[lane][following]); });
        });
  }

  /// Those of the vertices number(lane).
  template <class Number>
  Point2<V> positions_of(const Number& number) const {
    return {joined<T>([&](int lane) { return points_[number(lane)].x; }),
            joined<T>([&](int lane) { return points_[number(lane)].y; })};
  }

  template <class MetricIn>
  static Metric metrics(const MetricIn& metric_in) {
    if constexpr (shaped) {
      std::array<EdgeTensor<T>, lanes> one;
      for (int lane = 0; lane < lanes; ++lane) {
        one[lane] = metric_in(lane);
      }
      return {joined<T>([&](int lane) { return one[lane].xx; }), joined<T>([&](int lane) { return one[lane].xy; }),
              joined<T>([&](int lane) { return one[lane].yy; })};
    } else {
      return {};
    }
  }

  const Method& method_;
  const RingView& rings_;
  std::span<const Point2<T>> points_;
  const T* inverse_areas_;
  SidesInLanes<T, Metric> sides_;
  RingGatherer<T> gatherer_;
};

}  // namespace trismooth

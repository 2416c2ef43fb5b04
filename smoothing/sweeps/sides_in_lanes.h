// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/ring_sides.h"
#include "trismooth/smoothing/sweeps/lanes.h"

namespace trismooth {

/// Larger rings are visited alone.
inline constexpr int largest_ring_in_lanes = 16;

/// The sides of several rings, all of one size, one ring in each lane; otherwise as SidesInTurn. What does not change
/// where the vertices move is kept. (A walk of its own beside for_elements_around(), by which the machine code for AVX2
/// would be half as long again.)
template <class T, int bytes, class Metric>
class SidesInLanes {
 public:
  using V = Lanes<T, bytes>;
  using Mask = decltype(V{} < V{});

  struct Neighbour {
    Point2<V> position;
    V inverse_area;  ///< 1 / (twice the area to be aimed at) around it
  };

  /// Takes the sides of rings of up to largest_ring_in_lanes neighbours. neighbour(i): neighbour i of each;
  /// metric(corner): of the elements at neighbours of these places; `inverse_area`: around the vertices.
  template <class NeighbourAt, class MetricAt>
  void take(int size, V inverse_area, const NeighbourAt& neighbour, const MetricAt& metric) {
    for (int i = 0; i < size; ++i) {
      neighbours_[i] = neighbour(i);
    }
    neighbours_[size] = neighbours_[0];
    size_ = size;
    for (int i = 0; i < size; ++i) {
      sides_[i] = side_of<T>(TriangleCorner<Neighbour>{neighbours_[i], neighbours_[i + 1]}, inverse_area,
                             metric(TriangleCorner<int>{i, i + 1 < size ? i + 1 : 0}));
    }
  }

  template <int count, class Term>
  SideTotals<V, count> totals(Point2<V> position, const Term& term) const {
    auto result = SideTotals<V, count>::template none<T>();
    RingSpoke<V> next = spoke_to(neighbours_[0].position, position);
    for (int i = 0; i < size_; ++i) {
      const RingSpoke<V> previous = spoke_to(neighbours_[i + 1].position, position);
      result.add(term(element_of<T>(TriangleCorner<RingSpoke<V>>{next, previous}, sides_[i])));
      next = previous;
    }
    return result;
  }

  static bool any(const Mask& mask) {
    auto joined = mask[0];
    for (int lane = 1; lane < LanesOf<T, bytes>::count; ++lane) {
      joined |= mask[lane];
    }
    return joined != 0;
  }

 private:
  int size_ = 0;
  std::array<Neighbour, largest_ring_in_lanes + 1> neighbours_;  ///< the first one again at the end
  std::array<RingSide<V, Metric>, largest_ring_in_lanes> sides_;
};

}  // namespace trismooth

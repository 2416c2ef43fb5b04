// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <type_traits>
#include <utility>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/ring_sides.h"
#include "trismooth/smoothing/sweeps/lanes.h"

namespace trismooth {

/// Larger rings are visited alone.
inline constexpr int largest_ring_in_lanes = 16;

/// The sides of several rings, all of one size and of triangles or of quadrilaterals (`Corner`), one ring in each lane;
/// otherwise as SidesInTurn. What does not change where the vertices move is kept. (A walk of its own beside
/// for_elements_around(), by which the machine code for AVX2 would be half as long again.)
template <class T, int bytes, class Metric, template <class> class Corner>
class SidesInLanes {
 public:
  using V = Lanes<T, bytes>;
  using Mask = decltype(V{} < V{});

  struct Neighbour {
    Point2<V> position;
    V inverse_area;  ///< 1 / (twice the area to be aimed at) around it
  };

  static constexpr bool has_opposites = std::is_same_v<Corner<int>, QuadrilateralCorner<int>>;

  /// Takes the sides of rings of up to largest_ring_in_lanes neighbours. neighbour(i): neighbour i of each, and
  /// neighbour(size + i) the vertex opposite in its quadrilateral; metric(corner): of the elements at vertices of these
  /// places; `inverse_area`: around the vertices.
  template <class NeighbourAt, class MetricAt>
  void take(int size, V inverse_area, const NeighbourAt& neighbour, const MetricAt& metric) {
    for (int i = 0; i < size; ++i) {
      neighbours_[i] = neighbour(i);
      if constexpr (has_opposites) {
        opposites_[i] = neighbour(size + i);
      }
    }
    neighbours_[size] = neighbours_[0];
    size_ = size;
    for (int i = 0; i < size; ++i) {
      sides_[i] = side_of<T>(corner<Neighbour>(neighbours_[i], neighbours_[i + 1], [&] { return opposites_[i]; }),
                             inverse_area, metric(corner<int>(i, i + 1 < size ? i + 1 : 0, [&] { return size + i; })));
    }
  }

  template <int count, class Term>
  SideTotals<V, count> totals(Point2<V> position, const Term& term) const {
    auto result = SideTotals<V, count>::template none<T>();
    RingSpoke<V> next = spoke_to(neighbours_[0].position, position);
    for (int i = 0; i < size_; ++i) {
      const RingSpoke<V> previous = spoke_to(neighbours_[i + 1].position, position);
      const auto spokes =
          corner<RingSpoke<V>>(next, previous, [&] { return spoke_to(opposites_[i].position, position); });
      result.add(term(element_of<T>(spokes, sides_[i])));
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
  template <class Node, class Opposite>
  static Corner<Node> corner(const Node& next, const Node& previous, const Opposite& opposite) {
    if constexpr (has_opposites) {
      return {next, opposite(), previous};
    } else {
      return {next, previous};
    }
  }

  using Side = decltype(side_of<T>(std::declval<Corner<Neighbour>>(), V{}, Metric{}));

  int size_ = 0;
  std::array<Neighbour, largest_ring_in_lanes + 1> neighbours_;  ///< the first one again at the end
  std::array<Neighbour, has_opposites ? largest_ring_in_lanes : 1> opposites_;
  std::array<Side, largest_ring_in_lanes> sides_;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/ring_elements.h"

/// The elements around a vertex as the mean-ratio method sees them, one a side of its ring. Here T is a number, and V
/// one or several: T itself, or lanes of it in a register, for as many vertices at once.
namespace trismooth {

/// A symmetric tensor. The sum of e e^T over edges e says how long these are, and in which direction: a triangle is as
/// flat as they are, and lies as they do, where it is equilateral in the metric that is the inverse of that sum.
template <class V>
struct EdgeTensor {
  V xx = {};
  V xy = {};
  V yy = {};

  constexpr TRISMOOTH_HOST_DEVICE void add(const EdgeTensor& other) {
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
  }
  constexpr TRISMOOTH_HOST_DEVICE void add(Point2<V> edge) {
    xx += edge.x * edge.x;
    xy += edge.x * edge.y;
    yy += edge.y * edge.y;
  }
};

/// The squared length of e where the tensor is the metric.
template <class V>
constexpr TRISMOOTH_HOST_DEVICE V squared_length_in(const EdgeTensor<V>& metric, Point2<V> e) {
  return (metric.xx * (e.x * e.x) + metric.yy * (e.y * e.y)) + (metric.xy + metric.xy) * (e.x * e.y);
}

/// The metric, of determinant 1, in which a triangle with edges of that sum is equilateral; Euclid's where it is none.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE EdgeTensor<T> metric_of(const EdgeTensor<T>& edges) {
  const T determinant = edges.xx * edges.yy - edges.xy * edges.xy;
  if (!(determinant > T(0))) {
    return {T(1), T(0), T(1)};
  }
  const T scale = T(1) / std::sqrt(determinant);
  return {scale * edges.yy, -scale * edges.xy, scale * edges.xx};
}

/// The metric where shapes aimed at are equilateral.
template <class V>
struct EuclideanMetric {};

/// One side of a ring, and so one triangle of its vertex: what does not change where the vertex moves. `Metric`: the
/// one in which shapes count, of determinant 1: EdgeTensor or EuclideanMetric.
template <class V, class Metric>
struct RingSide {
  Point2<V> edge;
  V squared;       ///< its squared length
  V inverse_area;  ///< 1 / (twice the area that is aimed at)
  Metric metric;
};

/// That of a triangle. `Node` has a position and an inverse area, 1 / (twice the area that is aimed at) around it;
/// `inverse_area`: that of the vertex. The area aimed at in the triangle follows from their mean.
template <class T, class V, class Node, class Metric>
constexpr TRISMOOTH_HOST_DEVICE RingSide<V, Metric> side_of(const TriangleCorner<Node>& corner, V inverse_area,
                                                            const Metric& metric) {
  const auto& [from, to] = corner;
  const Point2<V> edge = to.position - from.position;
  return {edge, squared_length(edge), T(1) / T(3) * (inverse_area + from.inverse_area + to.inverse_area), metric};
}

/// The sides of a quadrilateral that do not end at its vertex, and what else does not change where that moves.
template <class V, class Metric>
struct RingQuadrilateral {
  Point2<V> from_next;    ///< to the opposite corner
  Point2<V> to_previous;  ///< from there
  V inverse_area;         ///< 1 / (the area that is aimed at): of each half, twice that
  Metric metric;
};

template <class T, class V, class Node, class Metric>
constexpr TRISMOOTH_HOST_DEVICE RingQuadrilateral<V, Metric> side_of(const QuadrilateralCorner<Node>& corner,
                                                                     V inverse_area, const Metric& metric) {
  const auto& [a, o, b] = corner;
  return {o.position - a.position, b.position - o.position,
          T(0.25) * ((inverse_area + o.inverse_area) + (a.inverse_area + b.inverse_area)), metric};
}

/// The triangle of a side, seen from the vertex. `shaped`: the shape that is aimed at is not equilateral.
template <class V, bool shaped>
struct SideTriangle {
  Point2<V> c;  ///< the side
  V doubled_area;
  V squares;    ///< the sum of the squared edge lengths
  V in_metric;  ///< that sum in the metric of the side
  V pull_x;     ///< of the vertex on that: minus half its derivative
  V pull_y;
  EdgeTensor<V> stiffness;  ///< half its second derivative
  V inverse_area;           ///< of the side
  V spoke;                  ///< the squared distance to the first end of the side
};

/// That of two spokes and their side.
template <class T, class V>
constexpr TRISMOOTH_HOST_DEVICE SideTriangle<V, false> element_of(const TriangleCorner<RingSpoke<V>>& corner,
                                                                  const RingSide<V, EuclideanMetric<V>>& side) {
  const auto& [a, b] = corner;
  const V squares = a.squared + b.squared + side.squared;
  const V two = V{} + T(2);
  return {side.edge,           cross(a.edge, b.edge), squares,           squares,  a.edge.x + b.edge.x,
          a.edge.y + b.edge.y, {two, V{}, two},       side.inverse_area, a.squared};
}
template <class T, class V>
constexpr TRISMOOTH_HOST_DEVICE SideTriangle<V, true> element_of(const TriangleCorner<RingSpoke<V>>& corner,
                                                                 const RingSide<V, EdgeTensor<V>>& side) {
  const auto& [a, b] = corner;
  const Point2<V> pull{a.edge.x + b.edge.x, a.edge.y + b.edge.y};
  const EdgeTensor<V>& metric = side.metric;
  return {side.edge,
          cross(a.edge, b.edge),
          a.squared + b.squared + side.squared,
          squared_length_in(metric, a.edge) + squared_length_in(metric, b.edge) + squared_length_in(metric, side.edge),
          metric.xx * pull.x + metric.xy * pull.y,
          metric.xy * pull.x + metric.yy * pull.y,
          {metric.xx + metric.xx, metric.xy + metric.xy, metric.yy + metric.yy},
          side.inverse_area,
          a.squared};
}

/// A quadrilateral, seen from the vertex: its three corners that change where the vertex moves. Each is the triangle of
/// its two sides, but `in_metric` and what follows from it are of these two alone; and so is `squares`, times such a
/// factor that equal sides at a right angle are worth as much as an equilateral triangle.
template <class V, bool shaped>
struct SideQuadrilateral {
  SideTriangle<V, shaped> corners[3];
  Point2<V> c;     ///< half the diagonal from the next to the previous corner
  V doubled_area;  ///< see size_of()
  V squares;
  V inverse_area;
  V spoke;  ///< the squared distance to the next corner
};

/// The squared length in the metric of a side, and the metric's product with a vector.
template <class V>
constexpr TRISMOOTH_HOST_DEVICE V squared_length_in(const EuclideanMetric<V>& /*metric*/, Point2<V> e) {
  return squared_length(e);
}
template <class V>
constexpr TRISMOOTH_HOST_DEVICE Point2<V> times(const EuclideanMetric<V>& /*metric*/, Point2<V> e) {
  return e;
}
template <class V>
constexpr TRISMOOTH_HOST_DEVICE Point2<V> times(const EdgeTensor<V>& metric, Point2<V> e) {
  return {metric.xx * e.x + metric.xy * e.y, metric.xy * e.x + metric.yy * e.y};
}
template <class T, class V>
constexpr TRISMOOTH_HOST_DEVICE EdgeTensor<V> stiffness_of(const EuclideanMetric<V>& /*metric*/, T factor) {
  return {V{} + factor, V{}, V{} + factor};
}
template <class T, class V>
constexpr TRISMOOTH_HOST_DEVICE EdgeTensor<V> stiffness_of(const EdgeTensor<V>& metric, T factor) {
  return {factor * metric.xx, factor * metric.xy, factor * metric.yy};
}

template <class T, class V, class Metric>
constexpr TRISMOOTH_HOST_DEVICE auto element_of(const QuadrilateralCorner<RingSpoke<V>>& corner,
                                                const RingQuadrilateral<V, Metric>& sides) {
  constexpr bool shaped = !std::is_same_v<Metric, EuclideanMetric<V>>;
  const auto& [a, o, b] = corner;
  const Metric& metric = sides.metric;
  // One corner, from the area of its two sides, their squares, the side of its triangle that does not end at the
  // vertex, what pulls at this, and how many sides end there.
  const auto at = [&](V doubled_area, V squares, V in_metric, Point2<V> c, Point2<V> spokes, T ends) {
    const Point2<V> pull = times(metric, spokes);
    return SideTriangle<V, shaped>{c,
                                   doubled_area,
                                   T(shape_constant / 2) * squares,
                                   in_metric,
                                   pull.x,
                                   pull.y,
                                   stiffness_of(metric, ends),
                                   sides.inverse_area,
                                   corner.next.squared};
  };
  const Point2<V> across = b.end - a.end;
  const V from2 = squared_length(sides.from_next);
  const V to2 = squared_length(sides.to_previous);
  const V a_in_metric = squared_length_in(metric, a.edge);
  const V b_in_metric = squared_length_in(metric, b.edge);
  return SideQuadrilateral<V, shaped>{
      {at(cross(a.edge, b.edge), a.squared + b.squared, a_in_metric + b_in_metric, across,
          {a.edge.x + b.edge.x, a.edge.y + b.edge.y}, T(2)),
       at(cross(a.edge, sides.from_next), a.squared + from2, a_in_metric + squared_length_in(metric, sides.from_next),
          sides.from_next, a.edge, T(1)),
       at(cross(b.edge, sides.to_previous), b.squared + to2, b_in_metric + squared_length_in(metric, sides.to_previous),
          sides.to_previous, b.edge, T(1))},
      {T(0.5) * across.x, T(0.5) * across.y},
      T(0.5) * cross(o.edge, across),
      (a.squared + b.squared) + (from2 + to2),
      sides.inverse_area,
      a.squared};
}

/// What a method finds for one element around a vertex, as it stands where the vertex is tried.
template <class V, int count>
struct SideTerms {
  V values[count];
  V margin;  ///< positive where the element is as it may be
  V share;   ///< share_of_error()
};

/// What a method finds for all elements around a vertex together.
template <class V, int count>
struct SideTotals {
  V sums[count];  ///< of the values, added in the order of the ring: the same bits whoever adds
  V smallest_margin;
  V largest_share;

  template <class T>
  static constexpr TRISMOOTH_HOST_DEVICE SideTotals none() {
    return {{}, V{} + std::numeric_limits<T>::max(), V{}};
  }
  constexpr TRISMOOTH_HOST_DEVICE void add(const SideTerms<V, count>& terms) {
    for (int i = 0; i < count; ++i) {
      sums[i] += terms.values[i];
    }
    smallest_margin = terms.margin < smallest_margin ? terms.margin : smallest_margin;
    largest_share = terms.share > largest_share ? terms.share : largest_share;
  }
};

/// The sides of one ring. Neighbour i is fetch(i), which has a position, and make(corner) the side of an element.
template <class T, class Ring, class Fetch, class Make>
class SidesInTurn {
 public:
  constexpr TRISMOOTH_HOST_DEVICE SidesInTurn(const Ring& ring, const Fetch& fetch, const Make& make)
      : ring_(ring), fetch_(fetch), make_(make) {}

  /// The totals of term(element) over the elements of a vertex at `position`.
  template <int count, class Term>
  constexpr TRISMOOTH_HOST_DEVICE SideTotals<T, count> totals(Point2<T> position, const Term& term) const {
    auto result = SideTotals<T, count>::template none<T>();
    for_elements_around(ring_, fetch_, [&](const auto& corner) {
      // A spoke is found again for the next side: kept until then, it costs a device registers.
      const auto spokes = corner.with([&](const auto& end) { return spoke_to(end.position, position); });
      result.add(term(element_of<T>(spokes, make_(corner))));
    });
    return result;
  }

  static constexpr TRISMOOTH_HOST_DEVICE bool any(bool is_so) { return is_so; }

 private:
  const Ring& ring_;
  Fetch fetch_;
  Make make_;
};

template <class T, class Ring, class Fetch, class Make>
constexpr TRISMOOTH_HOST_DEVICE SidesInTurn<T, Ring, Fetch, Make> sides_in_turn(const Ring& ring, const Fetch& fetch,
                                                                                const Make& make) {
  return {ring, fetch, make};
}

}  // namespace trismooth

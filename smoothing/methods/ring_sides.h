#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"

/// The triangles around a vertex, one a side of its ring. Here T is a number, and V one or several: T itself, or lanes
/// of it in a register, for as many vertices at once.
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

/// The edge from a vertex to a neighbour.
template <class V>
struct RingSpoke {
  Point2<V> edge;
  V squared;  ///< its squared length
};

template <class V>
constexpr TRISMOOTH_HOST_DEVICE RingSpoke<V> spoke_to(Point2<V> neighbour, Point2<V> position) {
  const Point2<V> edge = neighbour - position;
  return {edge, squared_length(edge)};
}

/// One side of a ring, and so one triangle of its vertex: what does not change where the vertex moves. `Metric`: the
/// one in which shapes count, of determinant 1: EdgeTensor or EuclideanMetric.
template <class V, class Metric>
struct RingSide {
  Point2<V> edge;
  V squared;       ///< its squared length
  V inverse_area;  ///< 1 / (twice the area that is aimed at)
  Metric metric;
};

/// That between two neighbours. `inverse_areas`: the sum of 1 / (twice the area that is aimed at) over the corners of
/// the triangle.
template <class T, class V, class Metric>
constexpr TRISMOOTH_HOST_DEVICE RingSide<V, Metric> side_between(Point2<V> from, Point2<V> to, V inverse_areas,
                                                                 const Metric& metric) {
  const Point2<V> edge = to - from;
  return {edge, squared_length(edge), T(1) / T(3) * inverse_areas, metric};
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

/// That between two spokes.
template <class T, class V>
constexpr TRISMOOTH_HOST_DEVICE SideTriangle<V, false> triangle_of(const RingSpoke<V>& a, const RingSpoke<V>& b,
                                                                   const RingSide<V, EuclideanMetric<V>>& side) {
  const V squares = a.squared + b.squared + side.squared;
  const V two = V{} + T(2);
  return {side.edge,           cross(a.edge, b.edge), squares,           squares,  a.edge.x + b.edge.x,
          a.edge.y + b.edge.y, {two, V{}, two},       side.inverse_area, a.squared};
}
template <class T, class V>
constexpr TRISMOOTH_HOST_DEVICE SideTriangle<V, true> triangle_of(const RingSpoke<V>& a, const RingSpoke<V>& b,
                                                                  const RingSide<V, EdgeTensor<V>>& side) {
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

/// What a method finds for one triangle around a vertex, as it stands where the vertex is tried.
template <class V, int count>
struct SideTerms {
  V values[count];
  V margin;  ///< positive where the triangle is as it may be
  V share;   ///< share_of_error()
};

/// What a method finds for all triangles around a vertex together.
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

/// The sides of one ring. Neighbour i is fetch(i), which has a position, and make(from, to) the side between two. Each
/// neighbour is fetched while the side before its own is worked on: a device waits long for its memory.
template <class T, class Ring, class Fetch, class Make>
class SidesInTurn {
 public:
  constexpr TRISMOOTH_HOST_DEVICE SidesInTurn(const Ring& ring, const Fetch& fetch, const Make& make)
      : ring_(ring), fetch_(fetch), make_(make) {}

  /// The totals of term(triangle) over the triangles of a vertex at `position`.
  template <int count, class Term>
  constexpr TRISMOOTH_HOST_DEVICE SideTotals<T, count> totals(Point2<T> position, const Term& term) const {
    auto result = SideTotals<T, count>::template none<T>();
    const int size = ring_.size();
    const auto first = fetch_(0);
    auto from = first;
    auto to = fetch_(1);
    for (int i = 2; i <= size + 1; ++i) {
      const auto following = i < size ? fetch_(i) : first;
      // A spoke is found again for the next side: kept until then, it costs a device registers.
      result.add(
          term(triangle_of<T>(spoke_to(from.position, position), spoke_to(to.position, position), make_(from, to))));
      from = to;
      to = following;
    }
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

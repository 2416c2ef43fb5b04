// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/quadrilateral_quality.h"
#include "trismooth/quality/triangle_quality.h"

/// The elements around a vertex, as its one-ring has them, and what is asked of one of them there: everything that goes
/// around a vertex takes them from for_elements_around(), and knows no more of them than the functions of a corner say.
///
/// All of them are triangles, but in a MixedRing, of which for_elements_around() visits quadrilaterals as well: these
/// are another type of corner with the same functions.
namespace trismooth {

/// A ring with quadrilaterals in it. ring[i] is neighbour i as ever, for i below ring.size(); where
/// ring.is_quadrilateral(i), the element between that and the next one has the vertex ring[ring.size() + i] opposite.
/// Whoever fetches what is to be known of neighbour i is asked for opposite vertices by the same numbers.
template <class Ring>
concept MixedRing = requires(const Ring& ring) {
  ring.is_quadrilateral(0);
};

/// A triangle around a vertex, seen from its corner there. `Node`: what is to be known of its other vertices.
template <class Node>
struct TriangleCorner {
  // Counter-clockwise. Each is the other end of a side at the vertex: a triangle has no vertex opposite of it.
  Node next;
  Node previous;

  /// The corner where value(node) is known in place of each node.
  template <class Value>
  constexpr TRISMOOTH_HOST_DEVICE auto with(const Value& value) const {
    return TriangleCorner<decltype(value(next))>{value(next), value(previous)};
  }
  /// Calls visit(node) for each.
  template <class Visit>
  constexpr TRISMOOTH_HOST_DEVICE void for_each(const Visit& visit) const {
    visit(next);
    visit(previous);
  }
  /// Whether is_so(node) of all of them. (No branch, which would be guessed wrong: & is meant.)
  template <class IsSo>
  constexpr TRISMOOTH_HOST_DEVICE bool all(const IsSo& is_so) const {
    const bool of_next = is_so(next);
    const bool of_previous = is_so(previous);
    return of_next & of_previous;
  }
};

/// A quadrilateral around a vertex, seen from its corner there.
template <class Node>
struct QuadrilateralCorner {
  // Counter-clockwise. A side ends at the first and at the last of them.
  Node next;
  Node opposite;
  Node previous;

  /// The corner where value(node) is known in place of each node.
  template <class Value>
  constexpr TRISMOOTH_HOST_DEVICE auto with(const Value& value) const {
    return QuadrilateralCorner<decltype(value(next))>{value(next), value(opposite), value(previous)};
  }
  /// Calls visit(node) for each.
  template <class Visit>
  constexpr TRISMOOTH_HOST_DEVICE void for_each(const Visit& visit) const {
    visit(next);
    visit(opposite);
    visit(previous);
  }
  /// Whether is_so(node) of all of them.
  template <class IsSo>
  constexpr TRISMOOTH_HOST_DEVICE bool all(const IsSo& is_so) const {
    return is_so(next) && is_so(opposite) && is_so(previous);
  }
};

/// Calls visit(corner) for the elements around a vertex, from the one between neighbours 0 and 1 on. node(i): what is
/// to be known of neighbour i; asked for once, and ahead of the element that it is not yet of: a device waits long for
/// its memory. A ring has two neighbours at least.
template <class Ring, class NodeAt, class Visit>
constexpr TRISMOOTH_HOST_DEVICE void for_elements_around(const Ring& ring, const NodeAt& node, const Visit& visit) {
  const auto size = static_cast<int>(ring.size());
  const auto first = node(0);
  auto next = first;
  auto previous = node(1);
  for (int i = 2; i <= size + 1; ++i) {
    const auto following = i < size ? node(i) : first;
    visit(TriangleCorner<decltype(node(0))>{next, previous});
    next = previous;
    previous = following;
  }
}

/// That of a ring with quadrilaterals. node(i) may be asked for more than once.
template <MixedRing Ring, class NodeAt, class Visit>
constexpr TRISMOOTH_HOST_DEVICE void for_elements_around(const Ring& ring, const NodeAt& node, const Visit& visit) {
  using Node = decltype(node(0));
  const auto size = static_cast<int>(ring.size());
  for (int i = 0; i < size; ++i) {
    const int after = i + 1 < size ? i + 1 : 0;
    if (ring.is_quadrilateral(i)) {
      visit(QuadrilateralCorner<Node>{node(i), node(size + i), node(after)});
    } else {
      visit(TriangleCorner<Node>{node(i), node(after)});
    }
  }
}

/// for_elements_around() where what is to be known of neighbour i is ring[i]: its number, or its position.
template <class Ring, class Visit>
constexpr TRISMOOTH_HOST_DEVICE void for_elements_around(const Ring& ring, const Visit& visit) {
  for_elements_around(
      ring, [&](int i) { return ring[i]; }, visit);
}

/// Which neighbour comes in place i where the last one of the ring comes first.
template <class Ring>
constexpr TRISMOOTH_HOST_DEVICE int from_last(const Ring& ring, int i) {
  return i == 0 ? static_cast<int>(ring.size()) - 1 : i - 1;
}

/// A MixedRing keeps its order: no element has to be found there by an earlier one's neighbour.
template <MixedRing Ring>
constexpr TRISMOOTH_HOST_DEVICE int from_last(const Ring& /*ring*/, int i) {
  return i;
}

/// The element around vertex v with this corner there, of vertices' numbers.
constexpr Triangle element_at(std::int32_t v, const TriangleCorner<std::int32_t>& corner) {
  return {v, corner.next, corner.previous};
}
constexpr MixedElement element_at(std::int32_t v, const QuadrilateralCorner<std::int32_t>& corner) {
  return {v, corner.next, corner.opposite, corner.previous};
}

/// The edge from a vertex to another one of an element. V: a number, or lanes of it, for as many vertices at once.
template <class V>
struct RingSpoke {
  Point2<V> end;
  Point2<V> edge;
  V squared;  ///< its squared length
};

template <class V>
constexpr TRISMOOTH_HOST_DEVICE RingSpoke<V> spoke_to(Point2<V> end, Point2<V> vertex) {
  const Point2<V> edge = end - vertex;
  return {end, edge, squared_length(edge)};
}

/// The shape quotient of an element, evaluated from the vertex that the spokes are of. (By value: handed over by
/// reference, the numbers of a corner would be in memory for too long for GCC to make lanes of them.)
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_quotient(TriangleCorner<RingSpoke<T>> corner) {
  const auto& [a, b] = corner;
  return shape_quotient(a.edge, b.edge, a.squared, squared_length(b.end - a.end), b.squared);
}

template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_quotient(const QuadrilateralCorner<RingSpoke<T>>& corner) {
  const auto& [a, o, b] = corner;
  return T(1 / shape_constant) * shape_of_sides(a.edge, o.end - a.end, b.end - o.end, Point2<T>{-b.edge.x, -b.edge.y});
}

/// Calls visit(quotient) with the shape quotient of each element around `position`, evaluated from there. Spokes are
/// shared between elements. (The loop of for_elements_around() once more: through another function GCC makes no lanes
/// of larger rings.)
template <class T, class Ring, class Visit>
constexpr TRISMOOTH_HOST_DEVICE void for_ring_quotients(Point2<T> position, const Ring& ring, const Visit& visit) {
  const RingSpoke<T> first = spoke_to<T>(ring[0], position);
  RingSpoke<T> next = first;
  for (int i = 1; i < ring.size(); ++i) {
    const RingSpoke<T> previous = spoke_to<T>(ring[i], position);
    visit(shape_quotient(TriangleCorner<RingSpoke<T>>{next, previous}));
    next = previous;
  }
  visit(shape_quotient(TriangleCorner<RingSpoke<T>>{next, first}));
}

template <class T, MixedRing Ring, class Visit>
constexpr TRISMOOTH_HOST_DEVICE void for_ring_quotients(Point2<T> position, const Ring& ring, const Visit& visit) {
  for_elements_around(
      ring, [&](int i) { return spoke_to<T>(ring[i], position); },
      [&](const auto& corner) { visit(shape_quotient(corner)); });
}

/// How large an element is. A quadrilateral counts as one of the two triangles into which a diagonal cuts it, on the
/// average over both: so it is compared with the triangles around it.
template <class V>
struct ElementSize {
  V doubled_area;
  V squares;  ///< the sum of the squared edge lengths
};

template <class V>
constexpr TRISMOOTH_HOST_DEVICE ElementSize<V> size_of(const TriangleCorner<RingSpoke<V>>& corner) {
  const auto& [a, b] = corner;
  return {cross(a.edge, b.edge), a.squared + b.squared + squared_length(b.end - a.end)};
}
template <class V>
constexpr TRISMOOTH_HOST_DEVICE ElementSize<V> size_of(const QuadrilateralCorner<RingSpoke<V>>& corner) {
  const auto& [a, o, b] = corner;
  return {V(0.5) * cross(o.edge, b.end - a.end),
          (a.squared + b.squared) + (squared_length(o.end - a.end) + squared_length(o.end - b.end))};
}

/// The shape quotient of an element of that size, the area of which is positive; 0 where it is inverted all the same.
template <class V>
constexpr TRISMOOTH_HOST_DEVICE V quotient_of(const TriangleCorner<RingSpoke<V>>& /*corner*/,
                                              const ElementSize<V>& size) {
  return size.doubled_area / size.squares;
}
template <class V>
constexpr TRISMOOTH_HOST_DEVICE V quotient_of(const QuadrilateralCorner<RingSpoke<V>>& corner,
                                              const ElementSize<V>& /*size*/) {
  const V quotient = shape_quotient(corner);
  return quotient > V(0) ? quotient : V(0);
}

}  // namespace trismooth

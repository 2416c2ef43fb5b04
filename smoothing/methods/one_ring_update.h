// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/method.h"

namespace trismooth {

/// What a method says of one vertex: a new position, or none. A method is a type with one static function
///
///     template <class T, class Ring> Move<T> update(Point2<T> position, const Ring& ring);
///
/// where ring.size() is the number of neighbours and ring[i] the position of neighbour i, counter-clockwise. Every
/// backend calls exactly this function, and finds it by the UpdateOf in the method's header. A method that uses the
/// smallest shape quotient around the vertex has another one that takes it as a third argument: see
/// update_with_minimum(). A method that knows more of a vertex than where its neighbours are is an object with
///
///     template <class Ring> Move<T> update(std::int32_t v, Point2<T> position, const Ring& ring) const;
///
/// where v is the number of the vertex and ring.number(i) that of neighbour i.
template <class T>
struct Move {
  Point2<T> position;
  bool moved;
};

template <class T>
constexpr TRISMOOTH_HOST_DEVICE Move<T> stay(Point2<T> position) {
  return {position, false};
}

/// Whether a vertex moves to `target`: not where that is where it is or no finite point. Of numbers or of lanes of
/// numbers, so without branches: & and | are meant.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE auto is_move(Point2<T> position, Point2<T> target) -> decltype(position.x == target.x) {
  return (target.x - target.x == T{}) & (target.y - target.y == T{}) &
         ((target.x != position.x) | (target.y != position.y));
}

/// A move to `target`, if it is one.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE Move<T> move_to(Point2<T> position, Point2<T> target) {
  return is_move(position, target) ? Move<T>{target, true} : stay(position);
}

/// The Laplacian position: the mean of the neighbours, summed in ring order (the paper's equations 1 and 2).
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE Point2<T> laplacian_position(const Ring& ring) {
  Point2<T> sum = ring[0];
  for (int i = 1; i < ring.size(); ++i) {
    const Point2<T> neighbour = ring[i];
    sum.x += neighbour.x;
    sum.y += neighbour.y;
  }
  const T weight = T(1) / static_cast<T>(ring.size());
  return {sum.x * weight, sum.y * weight};
}

/// The update of vertex v by a method of either kind.
template <class Update, class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE Move<T> updated(const Update& method, std::int32_t v, Point2<T> position,
                                                const Ring& ring) {
  if constexpr (requires { method.update(v, position, ring); }) {
    return method.update(v, position, ring);
  } else {
    return Update::template update<T>(position, ring);
  }
}

/// The sum of the squared distances of a vertex to its neighbours, added in ring order.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE T squares_around(Point2<T> position, const Ring& ring) {
  T sum = 0;
  for (int i = 0; i < ring.size(); ++i) {
    sum += squared_length(ring[i] - position);
  }
  return sum;
}

/// What a vertex does, and where it moves squares_around() where it was, by which the move is measured.
template <class T>
struct VertexMove {
  Move<T> move;
  T squares;
};

template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE VertexMove<T> with_squares(const Move<T>& move, Point2<T> position, const Ring& ring) {
  return {move, move.moved ? squares_around(position, ring) : T(0)};
}

/// The update of vertex v with what measures it. A method that has come by that sum has a function vertex_move().
template <class Update, class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE VertexMove<T> update_over(const Update& method, std::int32_t v, Point2<T> position,
                                                          const Ring& ring) {
  if constexpr (requires { method.vertex_move(v, position, ring); }) {
    return method.vertex_move(v, position, ring);
  } else {
    return with_squares(updated(method, v, position, ring), position, ring);
  }
}

/// The update of a vertex whose smallest shape quotient is stored, by the methods that have a use for it.
template <class Update, class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE Move<T> update_with_minimum(const Update& method, std::int32_t v, Point2<T> position,
                                                            const Ring& ring, T minimum) {
  if constexpr (requires { Update::template update<T>(position, ring, minimum); }) {
    return Update::template update<T>(position, ring, minimum);
  } else {
    return updated(method, v, position, ring);
  }
}

/// Whether nearly all vertices move in sweeps by an update, to the end of its stage: such sweeps visit all of them, and
/// nobody marks which. An update that is so says it by a constant of that name.
template <class Update>
inline constexpr bool moves_nearly_all = requires {
  requires Update::moves_nearly_all;
};

/// What visits the vertices for a method: specialised in the header of each, with a function visit() that calls another
/// one with the update of the method as it is in use. All that runs methods finds them by it.
template <Method method>
struct UpdateOf;

/// That of a method which knows no more of a vertex than its ring. For sweeps of the CPU, which compute many vertices
/// side by side, Update also has its Method, as `method`, a function target(), the place that update() looks at, and a
/// constant is_smart: whether it moves there by the rule of smart_move() only. For vertices that slide it has a
/// function along_line(): the place to go to, given that of the vertex and those of its neighbours, as lengths along
/// the line.
template <class Update>
struct UpdateByRing {
  using Type = Update;

  template <class MethodInUse, class Function>
  static decltype(auto) visit(const MethodInUse& /*in_use*/, Function&& function) {
    return function(Update{});
  }
};

}  // namespace trismooth

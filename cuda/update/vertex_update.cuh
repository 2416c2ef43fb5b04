// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/cuda/update/quadrilateral_fan.cuh"
#include "trismooth/cuda/update/quotient_filter.cuh"
#include "trismooth/cuda/update/reciprocals.cuh"
#include "trismooth/cuda/update/register_ring.cuh"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth::cuda {

/// laplacian_position(), by the same operations in the same order.
template <class T, int capacity>
__device__ Point2<T> laplacian_position(const RegisterRing<T, capacity>& ring) {
  Point2<T> sum = ring.neighbours[0];
  ring.for_places([&](auto i) {
    if (i > 0 && i < ring.size) {
      sum.x += ring.neighbours[i].x;
      sum.y += ring.neighbours[i].y;
    }
  });
  const T weight = small_reciprocal<T>(ring.size);
  return {sum.x * weight, sum.y * weight};
}

/// VertexMove::squares.
template <class T, int capacity>
__device__ T sum_of_squares(Point2<T> position, const RegisterRing<T, capacity>& ring) {
  T sum = 0;
  ring.for_places([&](auto i) {
    const T squared = squared_length(ring.neighbours[i] - position);
    sum = i < ring.size ? sum + squared : sum;
  });
  return sum;
}

/// Calls visit(i, corner) with the spokes from `position` to neighbour i and to the next one, of each place up to the
/// longest ring's end. (for_elements_around() for rings in registers, which have no size that all threads share.)
template <class T, int capacity, class Visit>
__device__ __forceinline__ void for_spokes(Point2<T> position, const RegisterRing<T, capacity>& ring,
                                           const Visit& visit) {
  const RingSpoke<T> first = spoke_to(ring.neighbours[0], position);
  RingSpoke<T> spoke = first;
  ring.for_places([&](auto i) {
    RingSpoke<T> next = first;
    if constexpr (i + 1 < capacity) {
      next = spoke_to(ring.neighbours[i + 1], position);
    }
    visit(i, TriangleCorner<RingSpoke<T>>{spoke, next});
    spoke = next;
  });
}

/// Twice the smallest quotient around `position`, approximately; no number where it is not sound. Adds the squared
/// spokes in ring order.
template <class T, int capacity>
__device__ __forceinline__ T approximate_minimum(Point2<T> position, const RegisterRing<T, capacity>& ring,
                                                 T& squares) {
  T minimum = 2;
  squares = 0;
  for_spokes(position, ring, [&](auto i, const TriangleCorner<RingSpoke<T>>& corner) {
    const T quotient = approximate_quotient(corner);
    if (i < ring.size) {
      minimum = smaller(minimum, quotient);
      squares += corner.next.squared;
    }
  });
  return minimum;
}

/// What a smart method does that looks at `target`, where the smallest quotient is approximately `before` and would be
/// `after`, if that is sound. `band`: how far two approximations have to be apart. False where the filter cannot tell.
template <class T>
__device__ __forceinline__ bool try_to_decide(Point2<T> position, Point2<T> target, T before, T after, bool sound,
                                              T band, Move<T>& move) {
  const T gain = after - before;
  // Where no element is inverted, a larger minimum says that none becomes it. (No branches: & and | are meant.)
  sound = (before > band) & is_sound_origin(position) & is_sound_origin(target) & sound;
  // Where the target is the position, nothing can be said that moves the vertex.
  const bool same = (target.x == position.x) & (target.y == position.y);
  move.moved = (gain > T(0)) & !same;
  move.position = move.moved ? target : position;
  return same | (sound & (fabs(gain) > band));
}

/// SmartLaplacian::update() and the tally's sum. False where the filter cannot tell.
template <class T, int capacity>
__device__ __forceinline__ bool try_update(SmartLaplacian, Point2<T> position, const RegisterRing<T, capacity>& ring,
                                           VertexMove<T>& result) {
  const Point2<T> target = laplacian_position(ring);
  const T before = approximate_minimum(position, ring, result.squares);
  T unused;
  const T after = approximate_minimum(target, ring, unused);
  return try_to_decide(position, target, before, after, true, FilterBand<T>::value, result.move);
}

/// The spokes to a vertex where its own is, and where it would go.
template <class T>
struct SpokesBeforeAndAfter {
  RingSpoke<T> before;
  RingSpoke<T> after;
};

/// The smallest of approximate_corner() at the three corners of a quadrilateral that change where the vertex moves.
/// `from_next` and `to_previous`: the sides that do not.
template <class T>
__device__ __forceinline__ T approximate_minimum(const RingSpoke<T>& next, const RingSpoke<T>& previous,
                                                 const RingSpoke<T>& from_next, const RingSpoke<T>& to_previous) {
  const T own = approximate_corner(next.edge, previous.edge, next.squared + previous.squared);
  const T at_next = approximate_corner(next.edge, from_next.edge, next.squared + from_next.squared);
  const T at_previous = approximate_corner(previous.edge, to_previous.edge, previous.squared + to_previous.squared);
  const T one = at_next < own ? at_next : own;
  return at_previous < one ? at_previous : one;
}

/// SmartMethod::update() and the tally's sum. False where the filter cannot tell. The corners opposite are as they are:
/// the smallest quotient gets larger if all of them, and all others afterwards, are above the smallest of the others
/// before.
template <class T, class Place>
__device__ __forceinline__ bool try_update(SmartMethod<Place>, Point2<T> position, const QuadrilateralFan<T>& ring,
                                           VertexMove<T>& result) {
  const Point2<T> target = Place::target(position, ring);
  const auto side = [](Point2<T> edge) { return RingSpoke<T>{{}, edge, approximate_squared_length(edge)}; };
  const auto smaller_one = [](T a, T b) { return b < a ? b : a; };
  constexpr auto least = static_cast<T>(smallest_sum);
  T before = 1;
  T after = 1;
  bool sound = true;
  const auto node = [&](int i) {
    RingSpoke<T> to = side(ring[i] - target);
    to.end = ring[i];
    return SpokesBeforeAndAfter<T>{spoke_to(ring[i], position), to};
  };
  for_elements_around(ring, node, [&](const QuadrilateralCorner<SpokesBeforeAndAfter<T>>& corner) {
    const auto& [next, opposite, previous] = corner;
    const RingSpoke<T> from_next = side(opposite.after.end - next.after.end);
    const RingSpoke<T> to_previous = side(previous.after.end - opposite.after.end);
    const T sum = from_next.squared + to_previous.squared;
    sound = sound & (next.before.squared >= least) & (next.after.squared >= least) & (sum >= least);
    before = smaller_one(before, approximate_minimum(next.before, previous.before, from_next, to_previous));
    after = smaller_one(after, approximate_minimum(next.after, previous.after, from_next, to_previous));
    after = smaller_one(after, approximate_corner(from_next.edge, to_previous.edge, sum));
  });
  result.squares = squares_around(position, ring);
  return try_to_decide(position, target, before, after, sound, FilterBand<T>::of_corners, result.move);
}

template <class T, int capacity>
__device__ __forceinline__ bool try_update(Laplacian, Point2<T> position, const RegisterRing<T, capacity>& ring,
                                           VertexMove<T>& result) {
  result.move = move_to(position, laplacian_position(ring));
  result.squares = sum_of_squares(position, ring);
  return true;
}

template <class T>
__device__ __forceinline__ bool try_update(Laplacian, Point2<T> position, const QuadrilateralFan<T>& ring,
                                           VertexMove<T>& result) {
  result.move = Laplacian::update(position, ring);
  result.squares = squares_around(position, ring);
  return true;
}

/// Whether a method has an update over such a ring in registers; other methods read their rings from memory.
template <class Update, class T, class Ring = RegisterRing<T, 8>>
inline constexpr bool has_register_update = requires(Point2<T> position, const Ring& ring, VertexMove<T>& result) {
  try_update(Update{}, position, ring, result);
};

}  // namespace trismooth::cuda

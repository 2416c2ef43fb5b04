#pragma once

#include "trismooth/cuda/update/quotient_filter.cuh"
#include "trismooth/cuda/update/reciprocals.cuh"
#include "trismooth/cuda/update/register_ring.cuh"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/methods/one_ring_update.h"

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

/// Calls visit(i, a, b, a_squared, b_squared) with the spokes from `position` to neighbour i and to the next one, of
/// each place up to the longest ring's end.
template <class T, int capacity, class Visit>
__device__ __forceinline__ void for_spokes(Point2<T> position, const RegisterRing<T, capacity>& ring,
                                           const Visit& visit) {
  const Point2<T> first = ring.neighbours[0] - position;
  const T first_squared = squared_length(first);
  Point2<T> spoke = first;
  T squared = first_squared;
  ring.for_places([&](auto i) {
    Point2<T> next = first;
    T next_squared = first_squared;
    if constexpr (i + 1 < capacity) {
      next = ring.neighbours[i + 1] - position;
      next_squared = squared_length(next);
    }
    visit(i, spoke, next, squared, next_squared);
    spoke = next;
    squared = next_squared;
  });
}

/// Twice the smallest quotient around `position`, approximately; no number where it is not sound. Adds the squared
/// spokes in ring order.
template <class T, int capacity>
__device__ __forceinline__ T approximate_minimum(Point2<T> position, const RegisterRing<T, capacity>& ring,
                                                 T& squares) {
  T minimum = 2;
  squares = 0;
  for_spokes(position, ring, [&](auto i, Point2<T> a, Point2<T> b, T a_squared, T b_squared) {
    const T quotient = approximate_quotient(a, b, a_squared, b_squared);
    if (i < ring.size) {
      minimum = smaller(minimum, quotient);
      squares += a_squared;
    }
  });
  return minimum;
}

/// SmartLaplacian::update() and the tally's sum. False where the filter cannot tell.
template <class T, int capacity>
__device__ __forceinline__ bool try_update(SmartLaplacian, Point2<T> position, const RegisterRing<T, capacity>& ring,
                                           VertexMove<T>& result) {
  const Point2<T> target = laplacian_position(ring);
  const T before = approximate_minimum(position, ring, result.squares);
  T unused;
  const T after = approximate_minimum(target, ring, unused);
  const T gain = after - before;
  // Where no element is inverted, a larger minimum says that none becomes it. (No branches: & and | are meant.)
  const bool sound = (before > FilterBand<T>::value) & is_sound_origin(position) & is_sound_origin(target);
  // Where the target is the position, nothing can be said that moves the vertex.
  const bool same = (target.x == position.x) & (target.y == position.y);
  result.move.moved = (gain > T(0)) & !same;
  result.move.position = result.move.moved ? target : position;
  return same | (sound & (fabs(gain) > FilterBand<T>::value));
}

template <class T, int capacity>
__device__ __forceinline__ bool try_update(Laplacian, Point2<T> position, const RegisterRing<T, capacity>& ring,
                                           VertexMove<T>& result) {
  result.move = move_to(position, laplacian_position(ring));
  result.squares = sum_of_squares(position, ring);
  return true;
}

/// Whether a method has an update in registers; other methods read their rings from memory.
template <class Update, class T>
inline constexpr bool has_register_update = requires(Point2<T> position, const RegisterRing<T, 8>& ring,
                                                     VertexMove<T>& result) {
  try_update(Update{}, position, ring, result);
};

}  // namespace trismooth::cuda

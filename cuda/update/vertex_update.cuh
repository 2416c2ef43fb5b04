// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

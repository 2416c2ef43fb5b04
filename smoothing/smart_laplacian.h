#pragma once

#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/one_ring_update.h"

namespace trismooth {

/// The worst of a vertex's triangles.
template <class T>
struct RingQuality {
  T worst;       ///< smallest shape quotient
  int inverted;  ///< triangles with a negative one
};

/// The quality of the triangles (v, n_i, n_i+1) around `position`, evaluated in this corner order. Stops as soon as
/// a quotient is not greater than `bound` (or is no number): `worst` is then that quotient, no more than an upper bound.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE RingQuality<T> ring_quality(Point2<T> position, const Ring& ring, T bound) {
  const int size = ring.size();
  RingQuality<T> quality{T(1), 0};
  const Point2<T> first = ring[0];
  const Point2<T> first_spoke = first - position;
  const T first_squared = squared_length(first_spoke);
  Point2<T> neighbour = first;
  Point2<T> spoke = first_spoke;
  T squared = first_squared;
  for (int i = 1; i <= size; ++i) {
    const Point2<T> next = i < size ? ring[i] : first;
    const Point2<T> next_spoke = i < size ? next - position : first_spoke;
    const T next_squared = i < size ? squared_length(next_spoke) : first_squared;
    const T quotient = shape_quotient(spoke, next_spoke, squared, squared_length(next - neighbour), next_squared);
    if (!(quotient > bound)) {
      return {quotient, quality.inverted};
    }
    quality.worst = quotient < quality.worst ? quotient : quality.worst;
    quality.inverted += quotient < T(0) ? 1 : 0;
    neighbour = next;
    spoke = next_spoke;
    squared = next_squared;
  }
  return quality;
}

/// Smart Laplacian smoothing (the paper, section 3.3.4): to the mean of the neighbours if and only if the smallest
/// quality of the vertex's triangles gets strictly larger, and no more of them are inverted than before.
struct SmartLaplacian {
  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Move<T> update(Point2<T> position, const Ring& ring) {
    const RingQuality<T> before = ring_quality(position, ring, T(-2));  // no quotient is below -1 / (2 sqrt(3))
    const Point2<T> target = laplacian_position<T>(ring);
    const RingQuality<T> after = ring_quality(target, ring, before.worst);
    return after.worst > before.worst && after.inverted <= before.inverted ? Move<T>{target, true} : stay(position);
  }
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth::cuda {

/// The positions of a ring of any size as an update reads them, straight from memory.
template <class T, class Ring>
struct RingInMemory {
  PointArray<T> points;
  Ring ring;
  std::int32_t count;

  __device__ int size() const { return count; }
  __device__ Point2<T> operator[](int i) const { return points.load(ring[i]); }
  __device__ std::int32_t number(int i) const { return ring[i]; }
  /// Of rings with quadrilaterals, which makes it a MixedRing.
  __device__ bool is_quadrilateral(int i) const requires MixedRing<Ring> { return ring.is_quadrilateral(i); }
};

/// That of a vertex among rings of any kind.
template <class T, class Rings>
__device__ auto ring_in_memory(const PointArray<T>& points, const Rings& rings, std::int32_t v) {
  return RingInMemory<T, decltype(rings.ring(v))>{points, rings.ring(v), rings.ring_size(v)};
}

}  // namespace trismooth::cuda

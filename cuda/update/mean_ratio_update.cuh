#pragma once

#include <cstdint>

#include "trismooth/cuda/update/register_ring.cuh"
#include "trismooth/cuda/update/vertex_update.cuh"
#include "trismooth/smoothing/methods/mean_ratio.h"

namespace trismooth::cuda {

/// Of the rings that the mean-ratio method updates in registers, which it needs many of.
inline constexpr int largest_ring_of_areas = 10;

/// A ring in registers with MeanRatioTargets::inverse_areas of its neighbours.
template <class T, int capacity>
struct RingOfAreas {
  const RegisterRing<T, capacity>& ring;
  const T (&inverse_areas)[capacity];

  template <class Visit>
  __device__ __forceinline__ void for_sides(const Visit& visit) const {
    ring.for_places([&](auto i) {
      if (i < ring.size) {
        constexpr int next = i + 1 < capacity ? i + 1 : 0;  // where a ring ends before, its first one is repeated
        visit(ring.neighbours[i], ring.neighbours[next], inverse_areas[i], inverse_areas[next]);
      }
    });
  }
};

/// MeanRatio::update() and the tally's sum. False where there is no energy.
template <class T, int capacity>
__device__ __forceinline__ bool try_update(const MeanRatio<T, false>& method, std::int32_t v, Point2<T> position,
                                           const RegisterRing<T, capacity>& ring, const T (&inverse_areas)[capacity],
                                           VertexMove<T>& result) {
  const auto attempt = method.try_update(v, position, RingOfAreas<T, capacity>{ring, inverse_areas});
  result.move = attempt.move;
  result.squares = attempt.move.moved ? sum_of_squares(position, ring) : T(0);
  return attempt.decided;
}

}  // namespace trismooth::cuda

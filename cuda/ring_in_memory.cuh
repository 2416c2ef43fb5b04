#pragma once

#include <cstdint>

#include "trismooth/cuda/point_arrays.h"

namespace trismooth::cuda {

/// The positions of a ring of any size as an update reads them, straight from memory.
template <class T, Layout layout>
struct RingInMemory {
  PointArrays<T, layout> points;
  const std::int32_t* ring;
  std::int32_t count;

  __device__ int size() const { return count; }
  __device__ Point2<T> operator[](int i) const { return points.load(__ldg(ring + i)); }
};

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "trismooth/cuda/packing/ring_views.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/sweeps/smallest_quotient.cuh"
#include "trismooth/cuda/sweeps/smallest_quotient.h"

namespace trismooth::cuda {

namespace {

template <class T, class Rings>
__global__ void __launch_bounds__(block_size) measure_all(Rings rings, PointArray<T> points, SweepSums* sums) {
  measure_quotients(rings, points, sums);
}

}  // namespace

template <class T, class Rings>
void launch_smallest_quotient(const Rings& rings, const PointArray<T>& points, SweepSums* sums, cudaStream_t stream) {
  constexpr unsigned most_blocks = 4096;
  const auto kernel = &measure_all<T, Rings>;
  kernel<<<std::min(blocks_for(rings.size), most_blocks), block_size, 0, stream>>>(rings, points, sums);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

#define INSTANTIATE(T, Rings) \
  template void launch_smallest_quotient(const Rings&, const PointArray<T>&, SweepSums*, cudaStream_t)
TRISMOOTH_WITH_RING_VIEWS(INSTANTIATE, float);
TRISMOOTH_WITH_RING_VIEWS(INSTANTIATE, double);

}  // namespace trismooth::cuda

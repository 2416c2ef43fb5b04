// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/sweeps/smallest_quotient.cuh"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/topology/rings.h"

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
INSTANTIATE(float, RingsView);
INSTANTIATE(float, SlottedMixedRingsView<std::int16_t>);
INSTANTIATE(float, SlottedMixedRingsView<std::int32_t>);
INSTANTIATE(float, SlottedRingsView<std::int16_t>);
INSTANTIATE(float, SlottedRingsView<std::int32_t>);
INSTANTIATE(double, RingsView);
INSTANTIATE(double, SlottedMixedRingsView<std::int16_t>);
INSTANTIATE(double, SlottedMixedRingsView<std::int32_t>);
INSTANTIATE(double, SlottedRingsView<std::int16_t>);
INSTANTIATE(double, SlottedRingsView<std::int32_t>);

}  // namespace trismooth::cuda

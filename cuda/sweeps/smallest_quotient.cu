#include <algorithm>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/runtime/error.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/sweeps/smallest_quotient.cuh"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/topology/rings.h"

namespace trismooth::cuda {

namespace {

template <class T, Layout layout, class Rings>
__global__ void __launch_bounds__(block_size) measure_all(Rings rings, PointArrays<T, layout> points, SweepSums* sums) {
  measure_quotients(rings, points, sums);
}

}  // namespace

template <class T, Layout layout, class Rings>
void launch_smallest_quotient(const Rings& rings, const PointArrays<T, layout>& points, SweepSums* sums,
                              cudaStream_t stream) {
  constexpr unsigned most_blocks = 4096;
  const auto kernel = &measure_all<T, layout, Rings>;
  kernel<<<std::min(blocks_for(rings.size), most_blocks), block_size, 0, stream>>>(rings, points, sums);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

#define INSTANTIATE_WITH(T, layout, Rings) \
  template void launch_smallest_quotient(const Rings&, const PointArrays<T, layout>&, SweepSums*, cudaStream_t)
#define INSTANTIATE(T, layout)                                 \
  INSTANTIATE_WITH(T, layout, RingsView);                      \
  INSTANTIATE_WITH(T, layout, SlottedRingsView<std::int16_t>); \
  INSTANTIATE_WITH(T, layout, SlottedRingsView<std::int32_t>)
INSTANTIATE(float, Layout::aos);
INSTANTIATE(float, Layout::soa);
INSTANTIATE(double, Layout::aos);
INSTANTIATE(double, Layout::soa);

}  // namespace trismooth::cuda

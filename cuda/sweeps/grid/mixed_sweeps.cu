// SPDX-License-Identifier: BSD-3-Clause
// Sweeps over meshes with quadrilaterals, in both forms.
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/sweeps/grid/sweeps_of_all.cuh"
#include "trismooth/cuda/sweeps/grid/sweeps_of_marked.cuh"

namespace trismooth::cuda {

#define INSTANTIATE(T, Slot)                                                                                         \
  template std::int32_t launch_sweeps_of_all(const MethodInUse<T>&, const GridMesh<T, SlottedMixedRingsView<Slot>>&, \
                                             const LoopRules&, std::span<const std::int32_t>, std::int32_t,          \
                                             LoopState*, SweepSums*, cudaStream_t);                                  \
  template void launch_sweeps_of_marked(const MethodInUse<T>&, const GridMesh<T, SlottedMixedRingsView<Slot>>&,      \
                                        const LoopRules&, std::int32_t, LoopState*, SweepSums*, unsigned long long*, \
                                        cudaStream_t)
INSTANTIATE(float, std::int16_t);
INSTANTIATE(float, std::int32_t);
INSTANTIATE(double, std::int16_t);
INSTANTIATE(double, std::int32_t);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
// Over meshes with quadrilaterals.
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/sweeps/grid/sweeps_of_marked.cuh"

namespace trismooth::cuda {

#define INSTANTIATE(T, Slot)                                                                                         \
  template void launch_sweeps_of_marked(const MethodInUse<T>&, const GridMesh<T, SlottedMixedRingsView<Slot>>&,      \
                                        const LoopRules&, std::int32_t, LoopState*, SweepSums*, unsigned long long*, \
                                        cudaStream_t)
INSTANTIATE(float, std::int16_t);
INSTANTIATE(float, std::int32_t);
INSTANTIATE(double, std::int16_t);
INSTANTIATE(double, std::int32_t);

}  // namespace trismooth::cuda

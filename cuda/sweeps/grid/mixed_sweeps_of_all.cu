// SPDX-License-Identifier: BSD-3-Clause
// Over meshes with quadrilaterals.
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/sweeps/grid/sweeps_of_all.cuh"

namespace trismooth::cuda {

#define INSTANTIATE(T, Slot)                                                                                         \
  template std::int32_t launch_sweeps_of_all(const MethodInUse<T>&, const GridMesh<T, SlottedMixedRingsView<Slot>>&, \
                                             const LoopRules&, std::span<const std::int32_t>, std::int32_t,          \
                                             LoopState*, SweepSums*, cudaStream_t)
INSTANTIATE(float, std::int16_t);
INSTANTIATE(float, std::int32_t);
INSTANTIATE(double, std::int16_t);
INSTANTIATE(double, std::int32_t);

}  // namespace trismooth::cuda

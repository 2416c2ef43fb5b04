// SPDX-License-Identifier: BSD-3-Clause
// Sweeps over meshes with quadrilaterals, in both forms.
#include "trismooth/cuda/sweeps/grid/sweeps_of_all.cuh"
#include "trismooth/cuda/sweeps/grid/sweeps_of_marked.cuh"
#include "trismooth/cuda/topology/rings.h"

namespace trismooth::cuda {

#define INSTANTIATE(T)                                                                                               \
  template std::int32_t launch_sweeps_of_all(const MethodInUse<T>&, const GridMesh<T, MixedRingsView>&,              \
                                             const LoopRules&, std::span<const std::int32_t>, std::int32_t,          \
                                             LoopState*, SweepSums*, cudaStream_t);                                  \
  template void launch_sweeps_of_marked(const MethodInUse<T>&, const GridMesh<T, MixedRingsView>&, const LoopRules&, \
                                        std::int32_t, LoopState*, SweepSums*, unsigned long long*, cudaStream_t)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda

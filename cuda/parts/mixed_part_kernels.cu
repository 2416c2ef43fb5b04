// SPDX-License-Identifier: BSD-3-Clause
// Visits of parts of meshes with quadrilaterals.
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/parts/part_batch.cuh"

namespace trismooth::cuda {

#define INSTANTIATE(T)                                                                                             \
  template void launch_part_batch(const MethodInUse<T>&, const PartBatch<T, SlottedMixedRingsView<std::int32_t>>&, \
                                  Visit, SweepSums*, cudaStream_t)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda

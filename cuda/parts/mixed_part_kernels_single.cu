// SPDX-License-Identifier: BSD-3-Clause
// Visits of parts of meshes with quadrilaterals, in single precision.
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/parts/part_batch.cuh"

namespace trismooth::cuda {

TRISMOOTH_PART_BATCH(float, SlottedMixedRingsView);

}  // namespace trismooth::cuda

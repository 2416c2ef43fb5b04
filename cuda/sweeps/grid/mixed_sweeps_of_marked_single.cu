// SPDX-License-Identifier: BSD-3-Clause
// Over meshes with quadrilaterals, in single precision.
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/sweeps/grid/sweeps_of_marked.cuh"

namespace trismooth::cuda {

TRISMOOTH_SWEEPS_OF_MARKED(float, SlottedMixedRingsView);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/sweeps/grid/sweeps_of_marked.cuh"

namespace trismooth::cuda {

std::size_t barrier_words(const LoopRules& rules) {
  return static_cast<std::size_t>(rules.sweeps) * (static_cast<std::size_t>(rules.batch_count) + 1);
}

TRISMOOTH_SWEEPS_OF_MARKED(float, SlottedRingsView);
TRISMOOTH_SWEEPS_OF_MARKED(double, SlottedRingsView);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth::cuda {

/// Adds the values of the threads that say `adds` to a list of their warp that has `listed` already. Returns how many
/// it has then. All threads of the warp call it; what is in the list is there after a __syncwarp().
template <class Value>
__device__ __forceinline__ int added_to_list(Value* list, int listed, bool adds, std::int32_t value) {
  const unsigned lanes = __ballot_sync(0xffffffffU, adds);
  if (adds) {
    list[listed + __popc(lanes & ((1U << (threadIdx.x % 32)) - 1))] = static_cast<Value>(value);
  }
  return listed + __popc(lanes);
}

}  // namespace trismooth::cuda

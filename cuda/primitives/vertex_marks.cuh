// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth::cuda {

/// Marks of vertices, a bit each in words of 32: the closed neighbourhood changed since the vertex was evaluated.
__device__ inline void mark(std::uint32_t* marks, std::int32_t v) {
  atomicOr(&marks[v / 32], 1U << (v % 32));
}

/// Words of marks that a warp lists vertices of at a time, each by a thread.
inline constexpr int words_at_a_time = 16;

/// Lists the marked vertices of begin .. end, or `all` of them, in the thread's word `w` of marks, and takes their
/// marks away; a word beyond the end has none. Returns how many the warp has listed. All threads of the warp call it.
__device__ inline int list_marked(std::uint32_t* marks, bool all, std::int64_t w, std::int32_t begin, std::int32_t end,
                                  std::int32_t* list) {
  constexpr unsigned all_lanes = 0xffffffffU;
  const unsigned lane = threadIdx.x % 32;
  std::uint32_t found = 0;
  std::int32_t first = 0;
  if (w * 32 < end) {
    first = static_cast<std::int32_t>(w * 32);
    // The marks of a batch's first and last word may belong to its neighbours.
    std::uint32_t within = ~0U;
    if (first < begin) {
      within <<= begin - first;
    }
    if (end - first < 32) {
      within &= (1U << (end - first)) - 1;
    }
    const std::uint32_t marked = *static_cast<volatile std::uint32_t*>(&marks[w]) & within;
    if (marked != 0) {
      atomicAnd(&marks[w], ~marked);
    }
    found = all ? within : marked;
  }
  if (__any_sync(all_lanes, found != 0) == 0) {
    return 0;
  }
  const int own = __popc(found);
  int before = own;
#pragma unroll
  for (unsigned distance = 1; distance < 32; distance *= 2) {
    const int other = __shfl_up_sync(all_lanes, before, distance);
    before += lane >= distance ? other : 0;
  }
  const int total = __shfl_sync(all_lanes, before, 31);
  __syncwarp();  // the list has been read
  for (std::int32_t* place = list + before - own; found != 0; found &= found - 1) {
    *place++ = first + __ffs(static_cast<int>(found)) - 1;
  }
  __syncwarp();
  return total;
}

}  // namespace trismooth::cuda

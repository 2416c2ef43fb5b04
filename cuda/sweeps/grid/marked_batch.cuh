// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/primitives/vertex_marks.cuh"
#include "trismooth/cuda/primitives/warp_list.cuh"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/sweeps/grid/vertex_visit.cuh"

/// A batch of which the marked vertices are evaluated, shared out to the warps of a grid.
namespace trismooth::cuda {

/// Updates the marked vertices of one batch that this warp, of a block of so many threads, looks after. `list` is its
/// own: of words_at_a_time * 32 numbers.
template <int threads, class Update, class T, class Rings>
__device__ void sweep_marked(const Update& method, std::uint32_t* marks, bool all, std::int32_t begin, std::int32_t end,
                             const SweepData<T, Rings>& data, std::int32_t* list, ThreadTally<T>& tally) {
  // The words of a warp are far apart: what changes is often near to each other.
  const std::int64_t warps = static_cast<std::int64_t>(gridDim.x) * (threads / 32);
  const std::int64_t warp = thread_index() / 32;
  const auto lane = static_cast<int>(threadIdx.x % 32);
  for (std::int64_t base = begin / 32; base * 32 < end; base += words_at_a_time * warps) {
    const std::int64_t beyond = static_cast<std::int64_t>(end) + 1;
    const int listed =
        list_marked(marks, all, lane < words_at_a_time ? base + lane * warps + warp : beyond, begin, end, list);
    tally.evaluated += lane == 0 ? static_cast<unsigned>(listed) : 0;
    int decided = 0;
    constexpr bool has_teams = updates_in_registers<Update, T, Rings> && !long_rings_go_alone<Rings>;
    if (!has_teams || listed > few_for_teams) {
      int left_over = 0;
      for (; listed - decided > (has_teams ? few_for_teams : 0); decided += 32) {
        const int i = decided + lane;
        const std::int32_t v = i < listed ? list[i] : 0;
        const bool left = visit<true>(method, v, fetch_record(data.rings, v), i < listed, data, tally);
        __syncwarp();
        left_over = added_to_list(list, left_over, left, v);
      }
      __syncwarp();
      visit_by_teams<true>(method, left_over, data, tally, [&](int i) { return list[i]; });
    }
    visit_by_teams<true>(method, listed - decided, data, tally, [&](int i) { return list[decided + i]; });
  }
}

}  // namespace trismooth::cuda

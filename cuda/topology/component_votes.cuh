// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/launch.h"

namespace trismooth::cuda {

/// What a triangle has to say on its component.
struct Vote {
  std::uint32_t component;
  bool positive;
  bool negative;
  bool decides_ties;  ///< where the votes are even, the lowest triangle that decides...
  bool tie_negative;  ///< ...decides so
};

/// The votes on each component. Integers: the order in which they are counted does not matter.
struct VoteCounts {
  static constexpr std::uint32_t nobody = 0xFFFFFFFFU;

  std::int32_t* margins;        ///< positive votes less negative ones; 0 at first
  std::uint32_t* tie_breakers;  ///< (the lowest triangle that decides << 1) | tie_negative; nobody at first
};

namespace component_votes_details {

inline constexpr unsigned warp_size = 32;
inline constexpr unsigned all_lanes = 0xFFFFFFFFU;

struct Subtotal {
  std::uint32_t component;
  std::int32_t margin;
  std::uint32_t tie_breaker;

  __device__ void add_to(const VoteCounts& counts) const {
    if (margin != 0) {
      atomicAdd(&counts.margins[component], margin);
    }
    if (tie_breaker != VoteCounts::nobody) {
      atomicMin(&counts.tie_breakers[component], tie_breaker);
    }
  }
};

/// What the lanes `voters` of a warp have to say together. `triangle` is the first lane's.
struct WarpVotes {
  unsigned positive;
  unsigned negative;
  unsigned deciding;
  unsigned tie_negative;

  __device__ Subtotal subtotal(std::uint32_t component, unsigned voters, std::uint32_t triangle) const {
    const std::int32_t margin = __popc(positive & voters) - __popc(negative & voters);
    const unsigned decides = deciding & voters;
    if (decides == 0) {
      return {component, margin, VoteCounts::nobody};
    }
    const unsigned lane = static_cast<unsigned>(__ffs(static_cast<int>(decides))) - 1;
    return {component, margin, ((triangle + lane) << 1U) | (tie_negative >> lane & 1U)};
  }
};

/// Most meshes are one component, and all triangles of it would queue for one counter. So each warp keeps a subtotal of
/// its own as long as it meets one component alone. Blocks are whole warps.
template <class Votes>
__global__ void __launch_bounds__(block_size) count(std::uint32_t triangle_count, Votes votes, VoteCounts counts) {
  const unsigned lane = threadIdx.x % warp_size;
  const std::uint64_t stride = std::uint64_t{gridDim.x} * blockDim.x;
  Subtotal held{0, 0, VoteCounts::nobody};
  // All lanes of a warp run through this loop equally often: `first` is the same for them.
  for (std::uint64_t first = std::uint64_t{blockIdx.x} * blockDim.x + (threadIdx.x - lane); first < triangle_count;
       first += stride) {
    const bool present = first + lane < triangle_count;
    const Vote vote = present ? votes(static_cast<std::uint32_t>(first + lane))
                              : Vote{VoteCounts::nobody, false, false, false, false};
    const WarpVotes warp{__ballot_sync(all_lanes, vote.positive), __ballot_sync(all_lanes, vote.negative),
                         __ballot_sync(all_lanes, vote.decides_ties), __ballot_sync(all_lanes, vote.tie_negative)};
    const std::uint32_t component = __shfl_sync(all_lanes, vote.component, 0);
    const auto triangle = static_cast<std::uint32_t>(first);
    if (__all_sync(all_lanes, !present || vote.component == component)) {
      const Subtotal here = warp.subtotal(component, all_lanes, triangle);
      if (held.component == component) {
        held.margin += here.margin;
        held.tie_breaker = min(held.tie_breaker, here.tie_breaker);
      } else {
        if (lane == 0) {
          held.add_to(counts);
        }
        held = here;
      }
    } else {
      const unsigned voters = __match_any_sync(all_lanes, vote.component);
      if (present && lane + 1 == static_cast<unsigned>(__ffs(static_cast<int>(voters)))) {
        warp.subtotal(vote.component, voters, triangle).add_to(counts);
      }
    }
  }
  if (lane == 0) {
    held.add_to(counts);
  }
}

}  // namespace component_votes_details

/// Queues the counting of votes(t) for all triangles t below `triangle_count`.
template <class Votes>
void count_votes(const Context& context, std::uint32_t triangle_count, const Votes& votes, const VoteCounts& counts) {
  constexpr unsigned most_blocks = 2048;
  if (triangle_count > 0) {
    const unsigned blocks = std::min(blocks_for(triangle_count), most_blocks);
    component_votes_details::count<<<blocks, block_size, 0, context.stream()>>>(triangle_count, votes, counts);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth::cuda {

/// Joins what the threads of a block did in the block's shared sums. All threads of the block call it; a barrier comes
/// before the sums are read. `Tally`: of one sweep or of one thread.
template <class Tally>
__device__ void join_in_block(const Tally& tally, SweepSums& shared) {
  constexpr unsigned all = 0xffffffffU;
  if (!__any_sync(all, tally.evaluated > 0 || tally.moved > 0)) {
    return;
  }
  const unsigned evaluated = __reduce_add_sync(all, static_cast<unsigned>(tally.evaluated));
  const unsigned moved = __reduce_add_sync(all, static_cast<unsigned>(tally.moved));
  const bool beyond = __any_sync(all, !tally.within_tolerance) != 0;
  auto largest = tally.max_relative_squared;
  for (int distance = 16; distance > 0 && moved > 0; distance /= 2) {
    const auto other = __shfl_xor_sync(all, largest, distance);
    largest = other > largest ? other : largest;
  }
  if (threadIdx.x % 32 == 0) {
    atomicAdd(&shared.evaluated, static_cast<unsigned long long>(evaluated));
    if (moved > 0) {
      atomicAdd(&shared.moved, static_cast<unsigned long long>(moved));
      atomicMax(&shared.max_relative, std::bit_cast<unsigned long long>(static_cast<double>(largest)));
      if (beyond) {
        atomicAdd(&shared.beyond_tolerance, 1ULL);
      }
    }
  }
}

/// Adds a block's sums to those of the sweep. One thread calls it.
__device__ inline void add_block(const SweepSums& shared, SweepSums* sums) {
  if (shared.evaluated > 0) {
    atomicAdd(&sums->evaluated, shared.evaluated);
  }
  if (shared.moved > 0) {
    atomicAdd(&sums->moved, shared.moved);
    atomicMax(&sums->max_relative, shared.max_relative);
    if (shared.beyond_tolerance > 0) {
      atomicAdd(&sums->beyond_tolerance, shared.beyond_tolerance);
    }
  }
}

/// Adds what the threads of a block did to the sums of the sweep. All threads of the block call it; `shared` is theirs.
/// `Tally`: as join_in_block().
template <class Tally>
__device__ void add_to_sums(const Tally& tally, SweepSums& shared, SweepSums* sums) {
  if (threadIdx.x == 0) {
    shared = SweepSums{};
  }
  __syncthreads();
  join_in_block(tally, shared);
  __syncthreads();
  if (threadIdx.x == 0) {
    add_block(shared, sums);
  }
  // The block's next tally starts by clearing what its first thread has just read.
  __syncthreads();
}

/// Joins the smallest quotients that the threads of a warp have seen (infinity: none) to the sums of the sweep. All
/// threads of the warp call it.
__device__ inline void join_min_quotient(double quotient, SweepSums* sums) {
  for (int distance = 16; distance > 0; distance /= 2) {
    const double other = __shfl_xor_sync(0xffffffffU, quotient, distance);
    quotient = other < quotient ? other : quotient;
  }
  if (threadIdx.x % 32 == 0 && quotient < std::numeric_limits<double>::infinity()) {
    atomicMax(&sums->min_quotient, falling_key(quotient));
  }
}

}  // namespace trismooth::cuda

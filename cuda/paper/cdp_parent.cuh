// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/paper/paper_kernels.cuh"
#include "trismooth/cuda/sweeps/block_tally.cuh"

namespace trismooth::cuda {

inline constexpr unsigned parent_block_size = 1024;

/// What the CDP version's parent does in one launch, apart from launching: the pass over the batch that is next, by one
/// block, and after the last batch of a sweep the decision to stop. All threads of the block call it; `state` is
/// written by the first. True where the pass just made was not the last.
template <class Update, class Mesh>
__device__ bool parent_pass(const Update& method, const Mesh& mesh, const LoopRules& rules, LoopState* state,
                            SweepSums* sums, SweepSums& shared) {
  using T = typename Mesh::Scalar;
  const std::int32_t batch = state->batch;
  const std::int32_t sweep = state->sweeps;
  const std::int32_t from = state->current;
  const std::int32_t to = rules.swaps ? 1 - from : from;
  SweepTally<T> tally;
  for (std::int32_t v = rules.batches[batch] + static_cast<std::int32_t>(threadIdx.x); v < rules.batches[batch + 1];
       v += static_cast<std::int32_t>(blockDim.x)) {
    relocate(method, mesh, v, from, to, rules.tolerance, tally);
  }
  __syncthreads();
  add_to_sums(tally, shared, &sums[sweep]);
  const bool ends_sweep = batch + 1 == rules.batch_count;
  if (ends_sweep && rules.measures_shape) {
    measure_in_block(mesh, rules.batches[rules.batch_count], to, &sums[sweep]);
    __syncthreads();
  }
  const std::int32_t stop = ends_sweep ? stop_after(sums[sweep], rules) : LoopState::running;
  const std::int32_t done = ends_sweep ? sweep + 1 : sweep;
  // Everybody has read the state and the sums.
  __syncthreads();
  if (threadIdx.x == 0) {
    state->current = to;
    state->batch = ends_sweep ? 0 : batch + 1;
    state->sweeps = done;
    state->stop = stop;
  }
  return stop == LoopState::running && done < rules.sweeps;
}

}  // namespace trismooth::cuda

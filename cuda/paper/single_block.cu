// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/paper/paper_kernels.cuh"
#include "trismooth/cuda/paper/single_block.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/sweeps/block_tally.cuh"

namespace trismooth::cuda {

namespace {

constexpr unsigned single_block_size = 1024;

template <class Update, class Mesh>
__global__ void __launch_bounds__(single_block_size)
    sweep_in_one_block(Update method, Mesh mesh, LoopRules rules, LoopState* state, SweepSums* sums) {
  using T = typename Mesh::Scalar;
  __shared__ SweepSums shared;
  const auto thread = static_cast<std::int32_t>(threadIdx.x);
  constexpr auto stride = static_cast<std::int32_t>(single_block_size);
  const std::int32_t free_count = rules.batches[rules.batch_count];
  std::int32_t from = state->current;
  std::int32_t stop = LoopState::running;
  std::int32_t sweep = 0;
  while (sweep < rules.sweeps && stop == LoopState::running) {
    const std::int32_t to = rules.swaps ? 1 - from : from;
    SweepTally<T> tally;
    for (std::int32_t batch = 0; batch < rules.batch_count; ++batch) {
      for (std::int32_t v = rules.batches[batch] + thread; v < rules.batches[batch + 1]; v += stride) {
        relocate(method, mesh, v, from, to, rules.tolerance, tally);
      }
      __syncthreads();
      const std::int32_t next = batch + 1 < rules.batch_count ? batch + 1 : 0;
      for (std::int32_t v = rules.batches[next] + thread; v < rules.batches[next + 1]; v += stride) {
        mesh.store_min_quality(v, evaluated_minimum(mesh, v, to));
      }
      __syncthreads();
    }
    add_to_sums(tally, shared, &sums[sweep]);
    from = to;
    if (rules.measures_shape) {
      measure_in_block(mesh, free_count, from, &sums[sweep]);
    }
    __syncthreads();
    stop = stop_after(sums[sweep], rules);
    ++sweep;
  }
  if (thread == 0) {
    state->current = from;
    state->sweeps = sweep;
    state->stop = stop;
  }
}

}  // namespace

template <class Mesh>
void launch_single_block(Method method, const Mesh& mesh, const LoopRules& rules, LoopState* state, SweepSums* sums,
                         cudaStream_t stream) {
  visit_paper_method(method, [&]<class Update>(const Update& update) {
    sweep_in_one_block<Update><<<1, single_block_size, 0, stream>>>(update, mesh, rules, state, sums);
  });
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

TRISMOOTH_INSTANTIATE_FOR_PAPER(launch_single_block);

}  // namespace trismooth::cuda

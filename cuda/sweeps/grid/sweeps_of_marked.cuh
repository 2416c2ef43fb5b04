// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "trismooth/cuda/primitives/grid_barrier.cuh"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_properties.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/cuda/sweeps/grid/grid_sweeps.h"
#include "trismooth/cuda/sweeps/grid/marked_batch.cuh"
#include "trismooth/cuda/sweeps/grid/vertex_visit.cuh"
#include "trismooth/cuda/sweeps/smallest_quotient.cuh"

/// Sweeps that evaluate the marked vertices, over rings of any kind. A source has TRISMOOTH_SWEEPS_OF_MARKED make those
/// that it is of.
namespace trismooth::cuda {

namespace sweeps_of_marked_details {

/// Threads of a block, one block on each multiprocessor: the fewer blocks, the faster their barrier.
constexpr int threads = 512;
/// Vertices that a block looks after at least: fewer blocks rather than idle ones.
constexpr std::int32_t smallest_share = 128;

/// Of so many sweeps the last two are looked at whether they only go to and fro.
constexpr std::int32_t sweeps_to_look = 16;

/// What a block does in a sweep, in its shared memory.
struct BlockWork {
  unsigned long long barrier_total;  ///< of grid_barrier()
  SweepSums sums;
  std::uint32_t differs;  ///< a vertex is elsewhere than two sweeps before
};

template <class T>
__device__ void swap_values(T& a, T& b) {
  const T old = a;
  a = b;
  b = old;
}

/// The decision after a sweep needs no more of the sums than how many vertices moved, and whether a block saw a move
/// beyond the tolerance, and a vertex that is elsewhere than two sweeps before: the blocks tell each other at the
/// sweep's last barrier. In the lowest 32 bits the moves, in 8 bits each the counts of blocks.
constexpr unsigned move_bits = 32;
constexpr unsigned block_bits = 8;
constexpr int most_blocks = (1 << block_bits) - 1;

template <class Update, class T, class Rings>
__global__ void __launch_bounds__(threads, 1) sweep_grid(Update method, GridMesh<T, Rings> mesh, LoopRules rules,
                                                         LoopState* state, SweepSums* sums, BarrierWord* barriers) {
  __shared__ BlockWork work;
  __shared__ std::int32_t lists[threads / 32][words_at_a_time * 32];
  std::int32_t stop = state->stop;
  bool all = rules.evaluates_all || state->evaluates_all != 0;
  if (threadIdx.x == 0) {
    work.sums = SweepSums{};
    work.differs = 0;
  }
  const auto nothing = [] {};
  SweepData<T, Rings> data{mesh.rings, mesh.first.points, rules.swaps ? mesh.second.points : mesh.first.points,
                           rules.swaps ? mesh.second.marks : mesh.first.marks, static_cast<T>(rules.tolerance)};
  std::uint32_t* marks = mesh.first.marks;
  std::int32_t current = state->current;
  const std::int32_t first_sweep = state->sweeps;
  std::int32_t sweep = first_sweep;
  if (current != 0) {
    swap_values(data.from, data.to);
    swap_values(marks, data.marks);
  }
  std::int32_t repeats = 0;
  __syncthreads();
  while (sweep < rules.sweeps && stop == LoopState::running) {
    const bool looks = rules.swaps && rules.remaining > 0 && sweep % sweeps_to_look >= sweeps_to_look - 2;
    data.differs = looks ? &work.differs : nullptr;
    ThreadTally<T> tally;
    for (std::int32_t batch = 0; batch < rules.batch_count; ++batch) {
      sweep_marked<threads>(method, marks, all, rules.batches[batch], rules.batches[batch + 1], data,
                            lists[threadIdx.x / 32], tally);
      if (batch + 1 < rules.batch_count) {
        grid_barrier(barriers++, 0, work.barrier_total, nothing);
      }
    }
    join_in_block(tally, work.sums);
    __syncthreads();
    const unsigned long long contribution = work.sums.moved +
                                            (work.sums.beyond_tolerance > 0 ? 1ULL << move_bits : 0ULL) +
                                            (!looks || work.differs != 0 ? 1ULL << (move_bits + block_bits) : 0ULL);
    const unsigned long long found = grid_barrier(barriers++, contribution, work.barrier_total, [&] {
      add_block(work.sums, &sums[sweep]);
      work.sums = SweepSums{};
      work.differs = 0;
    });
    all = rules.evaluates_all;
    if (rules.swaps) {
      swap_values(data.from, data.to);
      swap_values(marks, data.marks);
      current = 1 - current;
    }
    double min_shape = no_target;
    if (rules.measures_shape) {
      measure_quotients(data.rings, data.from, &sums[sweep]);
      grid_barrier(barriers++, 0, work.barrier_total, nothing);
      min_shape = min_shape_after(sums[sweep], rules);
    }
    constexpr unsigned long long move_field = (1ULL << move_bits) - 1;
    constexpr unsigned long long block_field = (1ULL << block_bits) - 1;
    const auto reason =
        reason_in_sweep(static_cast<std::int64_t>(found & move_field), (found >> move_bits & block_field) == 0,
                        rules.few_moves, min_shape, rules.target);
    stop = reason ? static_cast<std::int32_t>(*reason) : LoopState::running;
    ++sweep;
    // Twice, so that the last two sweeps evaluated what all further ones will.
    repeats = found >> (move_bits + block_bits) == 0 ? repeats + 1 : 0;
    if (stop == LoopState::running && repeats >= 2) {
      stop = LoopState::repeating;
      current = (rules.remaining - sweep) % 2 == 0 ? current : 1 - current;
    }
  }
  // Everybody has read the state before the last barrier; where no sweep was made, there was none, and nothing is new.
  if (thread_index() == 0 && sweep > first_sweep) {
    state->current = current;
    state->sweeps = sweep;
    state->stop = stop;
    state->evaluates_all = 0;
  }
}

template <class Update, class T, class Rings>
void launch_with(const Update& method, const GridMesh<T, Rings>& mesh, const LoopRules& rules,
                 std::int32_t largest_batch, LoopState* state, SweepSums* sums, BarrierWord* barriers,
                 cudaStream_t stream) {
  const int blocks = std::clamp(largest_batch / smallest_share, 1, std::min(multiprocessor_count(), most_blocks));
  Update method_argument = method;
  GridMesh<T, Rings> mesh_argument = mesh;
  LoopRules rules_argument = rules;
  void* arguments[] = {&method_argument, &mesh_argument, &rules_argument, &state, &sums, &barriers};
  const auto kernel = &sweep_grid<Update, T, Rings>;
  TRISMOOTH_CUDA_CHECK(cudaLaunchCooperativeKernel(
      reinterpret_cast<const void*>(kernel), dim3(static_cast<unsigned>(blocks)), dim3(threads), arguments, 0, stream));
}

}  // namespace sweeps_of_marked_details

template <class T, class Rings>
void launch_sweeps_of_marked(const MethodInUse<T>& method, const GridMesh<T, Rings>& mesh, const LoopRules& rules,
                             std::int32_t largest_batch, LoopState* state, SweepSums* sums,
                             unsigned long long* barriers, cudaStream_t stream) {
  visit_method(method, [&](const auto& update) {
    sweeps_of_marked_details::launch_with(update, mesh, rules, largest_batch, state, sums, barriers, stream);
  });
}

/// Instantiates launch_sweeps_of_marked() for numbers T in rings of the type Rings.
#define TRISMOOTH_SWEEPS_OF_MARKED_IN(T, Rings)                                                             \
  template void launch_sweeps_of_marked(const MethodInUse<T>&, const GridMesh<T, Rings>&, const LoopRules&, \
                                        std::int32_t, LoopState*, SweepSums*, unsigned long long*, cudaStream_t)

/// Instantiates launch_sweeps_of_marked() for numbers T in rings of the template Rings, with slots of either width.
#define TRISMOOTH_SWEEPS_OF_MARKED(T, Rings)             \
  TRISMOOTH_SWEEPS_OF_MARKED_IN(T, Rings<std::int16_t>); \
  TRISMOOTH_SWEEPS_OF_MARKED_IN(T, Rings<std::int32_t>)

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <type_traits>

#include "trismooth/cuda/runtime/dependent_launch.cuh"
#include "trismooth/cuda/runtime/device_properties.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/cuda/sweeps/grid/batch_pieces.cuh"
#include "trismooth/cuda/sweeps/grid/grid_sweeps.h"
#include "trismooth/cuda/sweeps/grid/vertex_visit.cuh"

/// Sweeps that evaluate every vertex, over rings of any kind. A source has TRISMOOTH_SWEEPS_OF_ALL make those that it
/// is of.
namespace trismooth::cuda {

namespace sweeps_of_all_details {

/// While more than one in so many vertices moves, all are evaluated: that is cheaper than to mark and to list them. In
/// Form B, where a sweep takes a launch for each colour, it is so for a shorter time.
constexpr std::uint64_t smallest_share_a = 16;
constexpr std::uint64_t smallest_share_b = 6;

/// Closes a sweep that evaluated every vertex. One thread calls it when all blocks are done.
__device__ inline void end_sweep(const LoopRules& rules, std::int32_t free_count, LoopState* state,
                                 const SweepSums& sums) {
  const volatile SweepSums& complete = sums;
  SweepSums found{};
  found.moved = complete.moved;
  found.beyond_tolerance = complete.beyond_tolerance;
  state->stop = stop_after(found, rules);
  ++state->sweeps;
  state->current = rules.swaps ? 1 - state->current : state->current;
  // Whether a sweep marks is said before it begins, and so which one is the last to evaluate every vertex.
  state->evaluates_all = state->marks == 0 ? 1 : 0;
  const std::uint64_t share = rules.swaps ? smallest_share_a : smallest_share_b;
  const bool many_move = found.moved > static_cast<std::uint64_t>(free_count) / share;
  state->marks = rules.evaluates_all || many_move ? 0 : 1;
}

/// Whether a launch that marks its moves, or does not, is the one that is to make the next sweep.
__device__ inline bool is_due(const LoopState& state, bool marks, const LoopRules& rules) {
  return state.stop == LoopState::running && state.evaluates_all != 0 && (state.marks != 0) == marks &&
         state.sweeps < rules.sweeps;
}

/// What a launch reads and writes.
template <class T, class Rings>
__device__ SweepData<T, Rings> data_of(const GridMesh<T, Rings>& mesh, const LoopRules& rules, const LoopState& state) {
  const bool second = state.current != 0;
  const bool to_second = rules.swaps ? !second : second;
  return {mesh.rings, second ? mesh.second.points : mesh.first.points,
          to_second ? mesh.second.points : mesh.first.points, to_second ? mesh.second.marks : mesh.first.marks,
          static_cast<T>(rules.tolerance)};
}

/// Makes the sweep of one batch, of which the last ends the sweep, where the state says that all vertices are to be
/// evaluated, and whether their moves are to be marked is what this kernel does.
template <bool marks, class Update, class T, class Rings>
__global__ void __launch_bounds__(batch_threads<Update, T, Rings>, blocks_at_once<Update, T, Rings>)
    sweep_batch(Update method, GridMesh<T, Rings> mesh, LoopRules rules, Pieces pieces, bool is_last, LoopState* state,
                SweepSums* sums) {
  wait_for_launch_before();
  if (!is_due(*state, marks, rules)) {
    return;
  }
  __shared__ SweepSums shared;
  const ThreadTally<T> tally = sweep_by_blocks<marks>(method, pieces, data_of(mesh, rules, *state));
  add_to_sums(tally, shared, &sums[state->sweeps]);
  if (is_last && threadIdx.x == 0) {
    __threadfence();
    if (atomicAdd(&state->blocks_done, 1U) + 1 == gridDim.x) {
      __threadfence();
      state->blocks_done = 0;
      end_sweep(rules, mesh.rings.size, state, sums[state->sweeps]);
    }
  }
}

}  // namespace sweeps_of_all_details

template <class T, class Rings>
std::int32_t launch_sweeps_of_all(const MethodInUse<T>& method, const GridMesh<T, Rings>& mesh, const LoopRules& rules,
                                  std::span<const std::int32_t> batches, std::int32_t sweeps, LoopState* state,
                                  SweepSums* sums, cudaStream_t stream) {
  const int multiprocessors = multiprocessor_count();
  std::int32_t launches = 0;
  visit_method(method, [&]<class Update>(const Update& update) {
    const auto launch_with = [&](auto marks, std::int32_t count) {
      DependentLaunch kernel(&sweeps_of_all_details::sweep_batch<marks(), Update, T, Rings>, stream);
      for (std::int32_t sweep = 0; sweep < count; ++sweep) {
        for (std::size_t batch = 0; batch + 1 < batches.size(); ++batch) {
          const auto [blocks, pieces] =
              launch_of_batch<Update, T, Rings>(batches[batch], batches[batch + 1], multiprocessors);
          kernel(blocks, batch_threads<Update, T, Rings>, update, mesh, rules, pieces, batch + 2 == batches.size(),
                 state, sums);
          ++launches;
        }
      }
    };
    launch_with(std::false_type{}, sweeps);
    if constexpr (!moves_nearly_all<Update>) {
      if (!rules.evaluates_all) {
        launch_with(std::true_type{}, 1);
      }
    }
  });
  return launches;
}

/// Instantiates launch_sweeps_of_all() for numbers T in rings of the type Rings.
#define TRISMOOTH_SWEEPS_OF_ALL_IN(T, Rings)                                                                      \
  template std::int32_t launch_sweeps_of_all(const MethodInUse<T>&, const GridMesh<T, Rings>&, const LoopRules&,  \
                                             std::span<const std::int32_t>, std::int32_t, LoopState*, SweepSums*, \
                                             cudaStream_t)

/// Instantiates launch_sweeps_of_all() for numbers T in rings of the template Rings, with slots of either width.
#define TRISMOOTH_SWEEPS_OF_ALL(T, Rings)             \
  TRISMOOTH_SWEEPS_OF_ALL_IN(T, Rings<std::int16_t>); \
  TRISMOOTH_SWEEPS_OF_ALL_IN(T, Rings<std::int32_t>)

}  // namespace trismooth::cuda

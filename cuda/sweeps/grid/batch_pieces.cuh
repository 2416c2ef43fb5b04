// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "trismooth/cuda/primitives/warp_list.cuh"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/cuda/sweeps/grid/vertex_visit.cuh"

/// A batch whose vertices are all evaluated, shared out to the blocks of a grid.
namespace trismooth::cuda {

/// Threads of a block that evaluates vertices, and such blocks of a multiprocessor: what their registers allow. Where a
/// method has no update in registers a thread has one vertex, and they are as many as hide the waiting for memory
/// without taking registers away. Quadrilaterals are worth more registers a thread than triangles.
template <class Update, class T, class Rings>
constexpr std::int32_t batch_threads =
    updates_in_registers<Update, T, Rings> && !long_rings_go_alone<Rings> ? 256 : 128;
template <class Update, class T, class Rings>
constexpr std::int32_t blocks_at_once = updates_in_registers<Update, T, Rings> && sizeof(T) == sizeof(float)
                                            ? (long_rings_go_alone<Rings> ? 5 : 3)
                                            : 512 / batch_threads<Update, T, Rings>;
constexpr std::int32_t longest_run_bits = 2;  ///< of Pieces

/// The vertices of a batch in pieces of as many as a block has threads. A block takes 2^run_bits pieces that follow
/// each other, then leaves as many to each of the others: what is near in number is near in the mesh and in the cache.
struct Pieces {
  std::int32_t begin;
  std::int32_t end;
  std::int32_t run_bits;

  /// The first vertex of the block's piece `i`; the end or more where there is none. `size`: threads of a block.
  template <std::int32_t size>
  __device__ std::int64_t first(std::int32_t i) const {
    const std::int32_t run =
        (i >> run_bits) * static_cast<std::int32_t>(gridDim.x) + static_cast<std::int32_t>(blockIdx.x);
    const std::int32_t piece = (run << run_bits) + (i & ((1 << run_bits) - 1));
    return begin + static_cast<std::int64_t>(piece) * size;
  }
};

/// More vertices than a warp leaves to its teams before it evaluates them, but for those of its last piece.
constexpr int enough_left_over = 32;

/// Evaluates the block's vertices by methods with an update in registers. `list` is the warp's own.
template <bool marks, class Update, class T, class Rings>
__device__ __forceinline__ void sweep_pieces(const Update& method, const Pieces& pieces,
                                             const SweepData<T, Rings>& data, std::int32_t* list,
                                             ThreadTally<T>& tally) {
  using Record = decltype(fetch_record(data.rings, 0));
  constexpr std::int32_t size = batch_threads<Update, T, Rings>;
  const auto thread = static_cast<std::int32_t>(threadIdx.x);
  const auto fetch = [&](std::int64_t first) {
    return first + thread < pieces.end ? fetch_record(data.rings, static_cast<std::int32_t>(first) + thread) : Record{};
  };
  std::int32_t piece = 0;
  std::int64_t first = pieces.first<size>(piece);
  Record record = fetch(first);
  while (first < pieces.end) {
    int listed = 0;
    do {
      // The next record is on its way while this one is worked on.
      const std::int64_t next_first = pieces.first<size>(++piece);
      const Record next = fetch(next_first);
      const bool active = first + thread < pieces.end;
      const std::int32_t v = static_cast<std::int32_t>(first) + thread;
      listed = added_to_list(list, listed, visit<marks>(method, v, record, active, data, tally), v);
      record = next;
      first = next_first;
    } while (listed < enough_left_over && first < pieces.end);
    __syncwarp();
    visit_by_teams<marks>(method, listed, data, tally, [&](int i) { return list[i]; });
    __syncwarp();
  }
}

/// Evaluates the block's vertices, a thread each, which reads its ring from memory: by methods without an update in
/// registers.
template <bool marks, class Update, class T, class Rings>
__device__ __forceinline__ void sweep_from_memory(const Update& method, const Pieces& pieces,
                                                  const SweepData<T, Rings>& data, ThreadTally<T>& tally) {
  const std::int64_t v = pieces.begin + thread_index();
  if (v < pieces.end) {
    const auto vertex = static_cast<std::int32_t>(v);
    const Point2<T> position = data.from.load(vertex);
    const auto update = [&](const auto& ring) { return update_over(method, vertex, position, ring); };
    settle_and_mark<marks>(vertex, position, data.rings.ring_size(vertex),
                           with_ring_in_memory(data.from, data.rings, vertex, update), data, tally);
  }
}

/// Evaluates the block's vertices. All threads of the block call it; what they did counts the vertices of the whole
/// batch as those of the grid's first thread.
template <bool marks, class Update, class T, class Rings>
__device__ __forceinline__ ThreadTally<T> sweep_by_blocks(const Update& method, const Pieces& pieces,
                                                          const SweepData<T, Rings>& data) {
  ThreadTally<T> tally;
  if constexpr (updates_in_registers<Update, T, Rings>) {
    __shared__ std::int32_t left_over[batch_threads<Update, T, Rings> / 32][enough_left_over + 32];
    sweep_pieces<marks>(method, pieces, data, left_over[threadIdx.x / 32], tally);
  } else {
    sweep_from_memory<marks>(method, pieces, data, tally);
  }
  if (thread_index() == 0) {
    tally.evaluated = static_cast<unsigned>(pieces.end - pieces.begin);
  }
  return tally;
}

/// How a batch is shared out to blocks.
struct BatchLaunch {
  unsigned blocks;
  Pieces pieces;
};

/// That of the vertices begin .. end on a device of so many multiprocessors.
template <class Update, class T, class Rings>
BatchLaunch launch_of_batch(std::int32_t begin, std::int32_t end, int multiprocessors) {
  const unsigned blocks = blocks_for(end - begin, batch_threads<Update, T, Rings>);
  if constexpr (updates_in_registers<Update, T, Rings>) {
    const auto most = static_cast<unsigned>(multiprocessors * blocks_at_once<Update, T, Rings>);
    return {std::min(blocks, most), {begin, end, blocks < (most << longest_run_bits) ? 0 : longest_run_bits}};
  } else {
    return {blocks, {begin, end, 0}};
  }
}

}  // namespace trismooth::cuda

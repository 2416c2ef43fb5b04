#pragma once

#include <cstdint>

#include "trismooth/cuda/primitives/warp_list.cuh"
#include "trismooth/cuda/sweeps/grid/vertex_visit.cuh"

/// A batch whose vertices are all evaluated, shared out to the blocks of a grid.
namespace trismooth::cuda {

/// Threads of such a block.
constexpr std::int32_t batch_threads = 256;
/// Blocks of a multiprocessor: what their registers allow.
template <class T>
constexpr std::int32_t blocks_at_once = sizeof(T) == sizeof(float) ? 3 : 2;
constexpr std::int32_t longest_run_bits = 2;  ///< of Pieces

/// The vertices of a batch in pieces of as many as a block has threads. A block takes 2^run_bits pieces that follow
/// each other, then leaves as many to each of the others: what is near in number is near in the mesh and in the cache.
struct Pieces {
  std::int32_t begin;
  std::int32_t end;
  std::int32_t run_bits;

  /// The first vertex of the block's piece `i`; the end or more where there is none.
  __device__ std::int64_t first(std::int32_t i) const {
    const std::int32_t run =
        (i >> run_bits) * static_cast<std::int32_t>(gridDim.x) + static_cast<std::int32_t>(blockIdx.x);
    const std::int32_t piece = (run << run_bits) + (i & ((1 << run_bits) - 1));
    return begin + static_cast<std::int64_t>(piece) * batch_threads;
  }
};

/// More vertices than a warp leaves to its teams before it evaluates them, but for those of its last piece.
constexpr int enough_left_over = 32;

/// Threads and blocks of a multiprocessor where a thread has one vertex: as many as hide the waiting for memory without
/// taking registers away.
constexpr std::int32_t threads_from_memory = 128;
constexpr std::int32_t blocks_from_memory = 4;

/// Evaluates the block's vertices. `list` is the warp's own.
template <bool marks, class Update, class T, class Slot>
__device__ __forceinline__ void sweep_pieces(const Update& method, const Pieces& pieces, const SweepData<T, Slot>& data,
                                             std::int32_t* list, ThreadTally<T>& tally) {
  const auto thread = static_cast<std::int32_t>(threadIdx.x);
  const auto fetch = [&](std::int64_t first) {
    return first + thread < pieces.end ? fetch_record(data.rings, static_cast<std::int32_t>(first) + thread)
                                       : RingRecord<Slot>{};
  };
  std::int32_t piece = 0;
  std::int64_t first = pieces.first(piece);
  RingRecord<Slot> record = fetch(first);
  while (first < pieces.end) {
    int listed = 0;
    do {
      // The next record is on its way while this one is worked on.
      const std::int64_t next_first = pieces.first(++piece);
      const RingRecord<Slot> next = fetch(next_first);
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

}  // namespace trismooth::cuda

#include <algorithm>

#include "trismooth/cuda/block_tally.cuh"
#include "trismooth/cuda/error.h"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/resident.h"
#include "trismooth/cuda/vertex_visit.cuh"

namespace trismooth::cuda {

namespace {

constexpr std::int32_t threads = 256;
/// Blocks of a multiprocessor: what their registers allow.
template <class T>
constexpr std::int32_t resident_blocks = sizeof(T) == sizeof(float) ? 3 : 2;
/// Rounds that a block makes with vertices one after the other at most: what is near in number is near in the mesh and
/// in the cache.
constexpr std::int32_t longest_run = 4;

/// While more than one in so many vertices moves, all are evaluated: that is cheaper than to mark and to list them.
constexpr std::uint64_t smallest_share = 6;

/// Closes a sweep that evaluated every vertex. One thread calls it when all blocks are done.
__device__ void end_sweep(const LoopRules& rules, std::int32_t free_count, LoopState* state, const SweepSums& sums) {
  const volatile SweepSums& complete = sums;
  SweepSums found{};
  found.moved = complete.moved;
  found.beyond_tolerance = complete.beyond_tolerance;
  state->stop = stop_after(found, rules);
  ++state->sweeps;
  state->current = rules.swaps ? 1 - state->current : state->current;
  // Whether a sweep marks is said before it begins, and so which one is the last to evaluate every vertex.
  state->evaluates_all = state->marks == 0 ? 1 : 0;
  const bool many_move = found.moved > static_cast<std::uint64_t>(free_count) / smallest_share;
  state->marks = rules.evaluates_all || many_move ? 0 : 1;
}

/// The vertices of a batch that a block goes through, as many as it has threads in each round: runs of `rounds` rounds,
/// one of every so many that there are blocks.
struct Runs {
  std::int32_t begin;
  std::int32_t end;
  std::int32_t rounds;
};

/// A block's way through its runs.
class Place {
 public:
  __device__ explicit Place(const Runs& runs)
      : first_(runs.begin + static_cast<std::int64_t>(blockIdx.x) * runs.rounds * threads), left_(runs.rounds) {}

  /// The first vertex of the round; beyond the end where there are no more.
  __device__ std::int64_t first() const { return first_; }
  __device__ void next(const Runs& runs) {
    first_ += threads;
    if (--left_ == 0) {
      left_ = runs.rounds;
      first_ += static_cast<std::int64_t>(gridDim.x - 1) * runs.rounds * threads;
    }
  }

 private:
  std::int64_t first_;
  std::int32_t left_;
};

/// Vertices that a warp leaves to its teams before it evaluates them.
constexpr int most_left_over = 64;

template <class Update, class T, Layout layout, class Slot>
__global__ void __launch_bounds__(threads, resident_blocks<T>)
    sweep_batch(ResidentMesh<T, layout, Slot> mesh, LoopRules rules, Runs runs, bool is_last, LoopState* state,
                SweepSums* sums) {
  if (state->stop != LoopState::running || state->evaluates_all == 0) {
    return;
  }
  __shared__ SweepSums shared;
  __shared__ std::int32_t left_over[threads / 32][most_left_over + 32];
  if (threadIdx.x == 0) {
    shared = SweepSums{};
  }
  __syncthreads();
  const bool second = state->current != 0;
  const bool to_second = rules.swaps ? !second : second;
  const bool marks = state->marks != 0;
  const SweepData<T, layout, Slot> data{
      mesh.rings, second ? mesh.second.points : mesh.first.points, to_second ? mesh.second.points : mesh.first.points,
      to_second ? mesh.second.marks : mesh.first.marks, static_cast<T>(rules.tolerance)};
  ThreadTally<T> tally;
  const auto thread = static_cast<std::int32_t>(threadIdx.x);
  std::int32_t* const list = left_over[threadIdx.x / 32];
  int listed = 0;
  const auto visit_left_over = [&] {
    __syncwarp();
    visit_by_teams<Update>(listed, marks, data, tally, [&](int i) { return list[i]; });
    __syncwarp();
    listed = 0;
  };
  Place place(runs);
  RingRecord<Slot> record{};
  if (place.first() + thread < runs.end) {
    record = fetch_record(data.rings, static_cast<std::int32_t>(place.first()) + thread);
  }
  while (place.first() < runs.end) {
    const bool active = place.first() + thread < runs.end;
    const std::int32_t v = static_cast<std::int32_t>(place.first()) + thread;
    // The next record is on its way while this one is worked on.
    place.next(runs);
    RingRecord<Slot> next{};
    if (place.first() + thread < runs.end) {
      next = fetch_record(data.rings, static_cast<std::int32_t>(place.first()) + thread);
    }
    add_to_list(visit<Update>(v, record, active, marks, data, tally), v, list, listed);
    record = next;
    if (listed > most_left_over || place.first() >= runs.end) {
      visit_left_over();
    }
  }
  join_in_block(tally, shared);
  __syncthreads();
  if (thread != 0) {
    return;
  }
  add_block(shared, &sums[state->sweeps]);
  if (is_last) {
    __threadfence();
    if (atomicAdd(&state->blocks_done, 1U) + 1 == gridDim.x) {
      __threadfence();
      state->blocks_done = 0;
      end_sweep(rules, mesh.rings.size, state, sums[state->sweeps]);
    }
  }
}

}  // namespace

template <class T, Layout layout, class Slot>
std::int32_t launch_sweeps_of_all(Method method, const ResidentMesh<T, layout, Slot>& mesh, const LoopRules& rules,
                                  std::span<const std::int32_t> batches, std::int32_t sweeps, LoopState* state,
                                  SweepSums* sums, cudaStream_t stream) {
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  int processors = 0;
  TRISMOOTH_CUDA_CHECK(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device));
  const std::int32_t most_blocks = processors * resident_blocks<T>;
  std::int32_t launches = 0;
  visit_method(method, [&]<class Update>(Update) {
    for (std::int32_t sweep = 0; sweep < sweeps; ++sweep) {
      for (std::size_t batch = 0; batch + 1 < batches.size(); ++batch) {
        const std::int32_t begin = batches[batch];
        const std::int32_t end = batches[batch + 1];
        const bool is_last = batch + 2 == batches.size();
        const auto rounds = static_cast<std::int32_t>(blocks_for(end - begin, threads));
        const std::int32_t run = std::clamp(rounds / most_blocks, 1, longest_run);
        const auto blocks = static_cast<unsigned>(std::min((rounds + run - 1) / run, most_blocks));
        sweep_batch<Update, T, layout, Slot>
            <<<blocks, threads, 0, stream>>>(mesh, rules, Runs{begin, end, run}, is_last, state, sums);
        TRISMOOTH_CUDA_CHECK(cudaGetLastError());
        ++launches;
      }
    }
  });
  return launches;
}

#define INSTANTIATE(T, layout, Slot)                                                                              \
  template std::int32_t launch_sweeps_of_all(Method, const ResidentMesh<T, layout, Slot>&, const LoopRules&,      \
                                             std::span<const std::int32_t>, std::int32_t, LoopState*, SweepSums*, \
                                             cudaStream_t)
INSTANTIATE(float, Layout::aos, std::int16_t);
INSTANTIATE(float, Layout::aos, std::int32_t);
INSTANTIATE(float, Layout::soa, std::int16_t);
INSTANTIATE(float, Layout::soa, std::int32_t);
INSTANTIATE(double, Layout::aos, std::int16_t);
INSTANTIATE(double, Layout::aos, std::int32_t);
INSTANTIATE(double, Layout::soa, std::int16_t);
INSTANTIATE(double, Layout::soa, std::int32_t);

}  // namespace trismooth::cuda

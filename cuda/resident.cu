#include <algorithm>

#include "trismooth/cuda/block_tally.cuh"
#include "trismooth/cuda/error.h"
#include "trismooth/cuda/grid_barrier.cuh"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/resident.h"
#include "trismooth/cuda/ring_in_memory.cuh"
#include "trismooth/cuda/thread_index.cuh"
#include "trismooth/smoothing/methods.h"

namespace trismooth::cuda {

namespace {

/// Threads of a block, one block on each multiprocessor: the fewer blocks, the faster their barrier.
constexpr int threads = 1024;
constexpr int warps = threads / 32;
/// Vertices that a block looks after at least: fewer blocks rather than idle ones.
constexpr std::int32_t smallest_chunk = 128;

/// What a block does in a sweep, in its shared memory.
struct BlockWork {
  std::uint16_t list[threads];       ///< vertices of a chunk to evaluate, from its first, ascending
  unsigned warp_counts[warps];       ///< of those, how many are of each warp
  unsigned long long barrier_total;  ///< of grid_barrier()
  SweepSums sums;
};

/// Evaluates one vertex and marks its neighbourhood where it moves. A vertex that is not marked is at the same place in
/// both buffers: a move marks the vertex itself for the next sweep.
template <class Update, class T, Layout layout>
__device__ void visit(std::int32_t v, const RingsView& rings, const ResidentBuffer<T, layout>& from,
                      const ResidentBuffer<T, layout>& to, T tolerance, SweepTally<T>& tally) {
  from.marked[v] = 0;
  // What never changes is read past the cache's coherence, so that it stays there from sweep to sweep.
  const std::uint32_t begin = __ldg(rings.offsets + v);
  const auto size = static_cast<std::int32_t>(__ldg(rings.offsets + v + 1) - begin);
  const RingInMemory<T, layout> ring{from.points, rings.neighbours + begin, size};
  const Point2<T> position = from.points.load(v);
  const Move<T> move = Update::template update<T>(position, ring);
  ++tally.evaluated;
  to.points.store(v, move.position);
  if (!move.moved) {
    return;
  }
  tally.join(tally_of_move(position, move.position, ring, tolerance));
  // Threads may mark the same vertex at the same time, with the same value.
  to.marked[v] = 1;
  for (std::int32_t i = 0; i < size; ++i) {
    const std::int32_t neighbour = __ldg(ring.ring + i);
    if (neighbour < rings.size) {
      to.marked[neighbour] = 1;
    }
  }
}

/// Lists the marked vertices from `first` to before `end` (no more of them than threads), and returns how many there
/// are. All threads of the block call it. So warps are full of vertices to evaluate, of rings of like size, however few
/// are marked.
__device__ unsigned list_marked(const std::uint8_t* marked, std::int32_t first, std::int32_t end, bool all,
                                BlockWork& work) {
  constexpr unsigned all_lanes = 0xffffffffU;
  const unsigned lane = threadIdx.x % 32;
  const unsigned warp = threadIdx.x / 32;
  const bool own = static_cast<std::int32_t>(threadIdx.x) < end - first && (all || marked[first + threadIdx.x] != 0);
  const unsigned in_warp = __ballot_sync(all_lanes, own);
  if (lane == 0) {
    work.warp_counts[warp] = static_cast<unsigned>(__popc(in_warp));
  }
  __syncthreads();
  const unsigned count = lane < warps ? work.warp_counts[lane] : 0;
  const unsigned total = __reduce_add_sync(all_lanes, count);
  const unsigned before = __reduce_add_sync(all_lanes, lane < warp ? count : 0);
  if (own) {
    const auto rank = static_cast<unsigned>(__popc(in_warp & ((1U << lane) - 1)));
    work.list[before + rank] = static_cast<std::uint16_t>(threadIdx.x);
  }
  __syncthreads();
  return total;
}

/// Updates the marked vertices of one batch that this block looks after, chunk after chunk.
template <class Update, class T, Layout layout>
__device__ void sweep_batch(const RingsView& rings, const LoopRules& rules, std::int32_t chunk_size, std::int32_t begin,
                            std::int32_t end, const ResidentBuffer<T, layout>& from,
                            const ResidentBuffer<T, layout>& to, BlockWork& work, SweepTally<T>& tally) {
  const std::int64_t stride = static_cast<std::int64_t>(gridDim.x) * chunk_size;
  for (std::int64_t chunk = begin + static_cast<std::int64_t>(blockIdx.x) * chunk_size; chunk < end; chunk += stride) {
    const auto first = static_cast<std::int32_t>(chunk);
    const std::int32_t chunk_end = end - first < chunk_size ? end : first + chunk_size;
    const unsigned listed = list_marked(from.marked, first, chunk_end, rules.evaluates_all, work);
    if (threadIdx.x < listed) {
      visit<Update>(first + work.list[threadIdx.x], rings, from, to, static_cast<T>(rules.tolerance), tally);
    }
    if (chunk + stride < end) {
      __syncthreads();  // before the list is written anew
    }
  }
}

template <class T, Layout layout>
__device__ void measure(const RingsView& rings, const PointArrays<T, layout>& points, SweepSums* sums) {
  double smallest = std::numeric_limits<double>::infinity();
  const std::int64_t stride = static_cast<std::int64_t>(gridDim.x) * blockDim.x;
  for (std::int64_t i = thread_index(); i < rings.size; i += stride) {
    const auto v = static_cast<std::int32_t>(i);
    const RingInMemory<T, layout> ring{points, rings.ring(v), rings.ring_size(v)};
    const auto quotient = static_cast<double>(worst_quotient(points.load(v), ring));
    smallest = quotient < smallest ? quotient : smallest;
  }
  join_min_quotient(smallest, sums);
}

template <class T, Layout layout>
__device__ void swap_buffers(ResidentBuffer<T, layout>& a, ResidentBuffer<T, layout>& b) {
  const ResidentBuffer<T, layout> old = a;
  a = b;
  b = old;
}

/// The decision after a sweep needs no more of the sums than whether a block saw a move, and one beyond the tolerance:
/// the blocks tell each other at the sweep's last barrier. Counts of blocks, in 16 bits each.
constexpr unsigned beyond_bits = 16;

template <class Update, class T, Layout layout>
__global__ void __launch_bounds__(threads, 1)
    sweep_resident(ResidentMesh<T, layout> mesh, LoopRules rules, std::int32_t chunk_size, LoopState* state,
                   SweepSums* sums, BarrierWord* barriers) {
  __shared__ BlockWork work;
  if (threadIdx.x == 0) {
    work.sums = SweepSums{};
  }
  const auto nothing = [] {};
  // Two buffers that change places: indexing them would put them into local memory.
  ResidentBuffer<T, layout> from = mesh.first;
  ResidentBuffer<T, layout> to = rules.swaps ? mesh.second : mesh.first;
  std::int32_t current = state->current;
  if (current != 0) {
    swap_buffers(from, to);
  }
  std::int32_t stop = LoopState::running;
  std::int32_t sweep = 0;
  __syncthreads();
  while (sweep < rules.sweeps && stop == LoopState::running) {
    SweepTally<T> tally;
    for (std::int32_t batch = 0; batch < rules.batch_count; ++batch) {
      sweep_batch<Update>(mesh.rings, rules, chunk_size, rules.batches[batch], rules.batches[batch + 1], from, to, work,
                          tally);
      if (batch + 1 < rules.batch_count) {
        grid_barrier(barriers++, 0, work.barrier_total, nothing);
      }
    }
    join_in_block(tally, work.sums);
    __syncthreads();
    const bool moved = work.sums.moved > 0;
    const bool beyond = work.sums.beyond_tolerance > 0;
    const unsigned long long found = grid_barrier(
        barriers++, (moved ? 1ULL : 0ULL) + (beyond ? 1ULL << beyond_bits : 0ULL), work.barrier_total, [&] {
          add_block(work.sums, &sums[sweep]);
          work.sums = SweepSums{};
        });
    if (rules.swaps) {
      swap_buffers(from, to);
      current = 1 - current;
    }
    double min_shape = no_target;
    if (rules.measures_shape) {
      measure(mesh.rings, from.points, &sums[sweep]);
      grid_barrier(barriers++, 0, work.barrier_total, nothing);
      min_shape = min_shape_after(sums[sweep], rules);
    }
    const auto reason = reason_in_sweep(found != 0 ? 1 : 0, found >> beyond_bits == 0, min_shape, rules.target);
    stop = reason ? static_cast<std::int32_t>(*reason) : LoopState::running;
    ++sweep;
  }
  if (thread_index() == 0) {
    state->current = current;
    state->sweeps = sweep;
    state->stop = stop;
  }
}

template <class T, Layout layout>
__global__ void __launch_bounds__(block_size)
    measure_min_quotient(RingsView rings, PointArrays<T, layout> points, SweepSums* sums) {
  measure(rings, points, sums);
}

template <class Update, class T, Layout layout>
void launch_with(const ResidentMesh<T, layout>& mesh, const LoopRules& rules, std::int32_t largest_batch,
                 LoopState* state, SweepSums* sums, BarrierWord* barriers, cudaStream_t stream) {
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  int processors = 0;
  TRISMOOTH_CUDA_CHECK(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device));
  // A share for every multiprocessor, in whole warps.
  std::int32_t chunk_size = std::clamp((largest_batch / processors + 31) / 32 * 32, smallest_chunk, threads);
  const int blocks = std::min(processors, (largest_batch + chunk_size - 1) / chunk_size);
  ResidentMesh<T, layout> mesh_argument = mesh;
  LoopRules rules_argument = rules;
  void* arguments[] = {&mesh_argument, &rules_argument, &chunk_size, &state, &sums, &barriers};
  const auto kernel = &sweep_resident<Update, T, layout>;
  TRISMOOTH_CUDA_CHECK(cudaLaunchCooperativeKernel(
      reinterpret_cast<const void*>(kernel), dim3(static_cast<unsigned>(blocks)), dim3(threads), arguments, 0, stream));
}

}  // namespace

std::size_t resident_barriers(const LoopRules& rules) {
  return static_cast<std::size_t>(rules.sweeps) * (static_cast<std::size_t>(rules.batch_count) + 1);
}

template <class T, Layout layout>
void launch_resident(Method method, const ResidentMesh<T, layout>& mesh, const LoopRules& rules,
                     std::int32_t largest_batch, LoopState* state, SweepSums* sums, unsigned long long* barriers,
                     cudaStream_t stream) {
  visit_method(method, [&]<class Update>(Update) {
    launch_with<Update>(mesh, rules, largest_batch, state, sums, barriers, stream);
  });
}

template <class T, Layout layout>
void launch_min_quotient(const RingsView& rings, const PointArrays<T, layout>& points, SweepSums* sums,
                         cudaStream_t stream) {
  constexpr unsigned most_blocks = 4096;
  const auto kernel = &measure_min_quotient<T, layout>;
  kernel<<<std::min(blocks_for(rings.size), most_blocks), block_size, 0, stream>>>(rings, points, sums);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

#define INSTANTIATE(T, layout)                                                                                      \
  template void launch_resident(Method, const ResidentMesh<T, layout>&, const LoopRules&, std::int32_t, LoopState*, \
                                SweepSums*, unsigned long long*, cudaStream_t);                                     \
  template void launch_min_quotient(const RingsView&, const PointArrays<T, layout>&, SweepSums*, cudaStream_t)
INSTANTIATE(float, Layout::aos);
INSTANTIATE(float, Layout::soa);
INSTANTIATE(double, Layout::aos);
INSTANTIATE(double, Layout::soa);

}  // namespace trismooth::cuda

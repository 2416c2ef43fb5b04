#include <algorithm>

#include <cooperative_groups.h>

#include "trismooth/cuda/block_tally.cuh"
#include "trismooth/cuda/error.h"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/resident.h"
#include "trismooth/cuda/ring_positions.cuh"
#include "trismooth/cuda/thread_index.cuh"
#include "trismooth/smoothing/methods.h"

namespace trismooth::cuda {

namespace {

/// Evaluates one vertex, if it is marked or all are wanted, and marks its neighbourhood where it moves. A vertex that
/// is not marked is at the same place in both buffers: a move marks the vertex itself for the next sweep.
template <class Update, class T, Layout layout>
__device__ void visit(std::int32_t v, const ResidentMesh<T, layout>& mesh, const LoopRules& rules, int from, int to,
                      SweepTally<T>& tally) {
  if (mesh.marked[from][v] == 0 && !rules.evaluates_all) {
    return;
  }
  mesh.marked[from][v] = 0;
  const RingPositions<T, layout> ring{mesh.points[from], mesh.rings.ring(v), mesh.rings.ring_size(v)};
  const Point2<T> position = mesh.points[from].load(v);
  const Move<T> move = Update::template update<T>(position, ring);
  ++tally.evaluated;
  mesh.points[to].store(v, move.position);
  if (!move.moved) {
    return;
  }
  tally.join(tally_of_move(position, move.position, ring, static_cast<T>(rules.tolerance)));
  // Threads may mark the same vertex at the same time, with the same value.
  std::uint8_t* const marked = mesh.marked[to];
  marked[v] = 1;
  for (std::int32_t i = 0; i < ring.count; ++i) {
    const std::int32_t neighbour = ring.ring[i];
    if (neighbour < mesh.rings.size) {
      marked[neighbour] = 1;
    }
  }
}

template <class T, Layout layout>
__device__ void measure(const RingsView& rings, const PointArrays<T, layout>& points, SweepSums* sums) {
  double smallest = std::numeric_limits<double>::infinity();
  const std::int64_t stride = static_cast<std::int64_t>(gridDim.x) * blockDim.x;
  for (std::int64_t i = thread_index(); i < rings.size; i += stride) {
    const auto v = static_cast<std::int32_t>(i);
    const RingPositions<T, layout> ring{points, rings.ring(v), rings.ring_size(v)};
    const auto quotient = static_cast<double>(worst_quotient(points.load(v), ring));
    smallest = quotient < smallest ? quotient : smallest;
  }
  join_min_quotient(smallest, sums);
}

template <class Update, class T, Layout layout>
__global__ void __launch_bounds__(block_size)
    sweep_resident(ResidentMesh<T, layout> mesh, LoopRules rules, LoopState* state, SweepSums* sums) {
  __shared__ SweepSums shared;
  const auto grid = cooperative_groups::this_grid();
  const std::int64_t first = thread_index();
  const std::int64_t stride = static_cast<std::int64_t>(gridDim.x) * blockDim.x;
  int from = state->current;
  std::int32_t stop = LoopState::running;
  std::int32_t sweep = 0;
  while (sweep < rules.sweeps && stop == LoopState::running) {
    const int to = rules.swaps ? 1 - from : from;
    SweepTally<T> tally;
    for (std::int32_t batch = 0; batch < rules.batch_count; ++batch) {
      const std::int64_t end = rules.batches[batch + 1];
      for (std::int64_t v = rules.batches[batch] + first; v < end; v += stride) {
        visit<Update>(static_cast<std::int32_t>(v), mesh, rules, from, to, tally);
      }
      if (batch + 1 == rules.batch_count) {
        add_to_sums(tally, shared, &sums[sweep]);
      }
      grid.sync();
    }
    from = to;
    if (rules.measures_shape) {
      measure(mesh.rings, mesh.points[from], &sums[sweep]);
      grid.sync();
    }
    stop = stop_after(sums[sweep], rules);
    ++sweep;
  }
  if (first == 0) {
    state->current = from;
    state->sweeps = sweep;
    state->stop = stop;
  }
}

template <class T, Layout layout>
__global__ void __launch_bounds__(block_size)
    measure_min_quotient(RingsView rings, PointArrays<T, layout> points, SweepSums* sums) {
  measure(rings, points, sums);
}

/// As many blocks as can be on the device at the same time, and no more than there is work for: a barrier of fewer
/// blocks is faster.
template <class Kernel>
unsigned resident_blocks(Kernel* kernel, std::int64_t vertices) {
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  int processors = 0;
  TRISMOOTH_CUDA_CHECK(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device));
  int blocks = 0;
  TRISMOOTH_CUDA_CHECK(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, block_size, 0));
  return std::max(1U, std::min(blocks_for(vertices), static_cast<unsigned>(processors * blocks)));
}

}  // namespace

template <class T, Layout layout>
void launch_resident(Method method, const ResidentMesh<T, layout>& mesh, const LoopRules& rules, LoopState* state,
                     SweepSums* sums, cudaStream_t stream) {
  visit_method(method, [&]<class Update>(Update) {
    const auto kernel = &sweep_resident<Update, T, layout>;
    ResidentMesh<T, layout> mesh_argument = mesh;
    LoopRules rules_argument = rules;
    void* arguments[] = {&mesh_argument, &rules_argument, &state, &sums};
    TRISMOOTH_CUDA_CHECK(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(kernel),
                                                     dim3(resident_blocks(kernel, mesh.rings.size)), dim3(block_size),
                                                     arguments, 0, stream));
  });
}

template <class T, Layout layout>
void launch_min_quotient(const RingsView& rings, const PointArrays<T, layout>& points, SweepSums* sums,
                         cudaStream_t stream) {
  const auto kernel = &measure_min_quotient<T, layout>;
  kernel<<<resident_blocks(kernel, rings.size), block_size, 0, stream>>>(rings, points, sums);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

template void launch_resident(Method, const ResidentMesh<float, Layout::aos>&, const LoopRules&, LoopState*, SweepSums*,
                              cudaStream_t);
template void launch_resident(Method, const ResidentMesh<float, Layout::soa>&, const LoopRules&, LoopState*, SweepSums*,
                              cudaStream_t);
template void launch_resident(Method, const ResidentMesh<double, Layout::aos>&, const LoopRules&, LoopState*,
                              SweepSums*, cudaStream_t);
template void launch_resident(Method, const ResidentMesh<double, Layout::soa>&, const LoopRules&, LoopState*,
                              SweepSums*, cudaStream_t);
template void launch_min_quotient(const RingsView&, const PointArrays<float, Layout::aos>&, SweepSums*, cudaStream_t);
template void launch_min_quotient(const RingsView&, const PointArrays<float, Layout::soa>&, SweepSums*, cudaStream_t);
template void launch_min_quotient(const RingsView&, const PointArrays<double, Layout::aos>&, SweepSums*, cudaStream_t);
template void launch_min_quotient(const RingsView&, const PointArrays<double, Layout::soa>&, SweepSums*, cudaStream_t);

}  // namespace trismooth::cuda

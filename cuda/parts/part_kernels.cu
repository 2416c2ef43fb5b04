// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "trismooth/cuda/parts/part_kernels.h"
#include "trismooth/cuda/primitives/vertex_marks.cuh"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_properties.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/cuda/sweeps/grid/batch_pieces.cuh"
#include "trismooth/cuda/sweeps/grid/marked_batch.cuh"
#include "trismooth/cuda/sweeps/grid/vertex_visit.cuh"

namespace trismooth::cuda {

namespace {

using Rings = SlottedRingsView<std::int32_t>;

template <class T>
__device__ SweepData<T, Rings> data_of(const PartBatch<T>& batch) {
  return {batch.rings, batch.from, batch.to, batch.next_marks, batch.tolerance};
}

template <bool marks, class Update, class T>
__global__ void __launch_bounds__(batch_threads<Update, T, Rings>, blocks_at_once<Update, T, Rings>)
    visit_all(Update method, PartBatch<T> batch, Pieces pieces, SweepSums* sums) {
  __shared__ SweepSums shared;
  const ThreadTally<T> tally = sweep_by_blocks<marks>(method, pieces, data_of(batch));
  add_to_sums(tally, shared, sums);
}

/// Threads of a block that visits marked vertices.
constexpr int marked_threads = 256;

template <class Update, class T>
__global__ void __launch_bounds__(marked_threads) visit_marked(Update method, PartBatch<T> batch, SweepSums* sums) {
  __shared__ SweepSums shared;
  __shared__ std::int32_t lists[marked_threads / 32][words_at_a_time * 32];
  ThreadTally<T> tally;
  constexpr bool all = false;
  sweep_marked<marked_threads>(method, batch.marks, all, batch.begin, batch.end, data_of(batch),
                               lists[threadIdx.x / 32], tally);
  add_to_sums(tally, shared, sums);
}

template <bool marks, class Update, class T>
void launch_all(const Update& update, const PartBatch<T>& batch, SweepSums* sums, cudaStream_t stream) {
  const auto [blocks, pieces] = launch_of_batch<Update, T, Rings>(batch.begin, batch.end, multiprocessor_count());
  visit_all<marks><<<blocks, batch_threads<Update, T, Rings>, 0, stream>>>(update, batch, pieces, sums);
}

template <class Update, class T>
void launch_marking(const Update& update, const PartBatch<T>& batch, Visit visit, SweepSums* sums,
                    cudaStream_t stream) {
  if (visit == Visit::all_and_mark) {
    launch_all<true>(update, batch, sums, stream);
    return;
  }
  constexpr std::int32_t vertices_a_warp = 32 * words_at_a_time;
  const unsigned blocks =
      std::min(blocks_for(batch.end - batch.begin, static_cast<unsigned>(marked_threads / 32 * vertices_a_warp)) + 1,
               static_cast<unsigned>(4 * multiprocessor_count()));
  visit_marked<<<blocks, marked_threads, 0, stream>>>(update, batch, sums);
}

template <class T>
__global__ void __launch_bounds__(block_size)
    gather(PointArray<T> points, const std::int32_t* vertices, std::int32_t count, PointRecord<T>* out) {
  const std::int64_t i = thread_index();
  if (i < count) {
    out[i] = points.points[vertices[i]];
  }
}

template <class T>
__global__ void __launch_bounds__(block_size)
    arrive(const PointRecord<T>* in, ArrivedGhosts ghosts, PointArray<T> from, PointArray<T> to, std::uint32_t* marks) {
  const std::int64_t i = thread_index();
  if (i >= ghosts.count) {
    return;
  }
  const std::int32_t ghost = ghosts.vertices[i];
  const PointRecord<T> now = in[i];
  const bool is_elsewhere = !have_same_bits(from.load(ghost), Point2<T>{now.x, now.y});
  to.points[ghost] = now;
  if (marks != nullptr && is_elsewhere) {
    for (std::uint32_t k = ghosts.offsets[i]; k < ghosts.offsets[i + 1]; ++k) {
      mark(marks, ghosts.around[k]);
    }
  }
}

}  // namespace

template <class T>
void launch_part_batch(const MethodInUse<T>& method, const PartBatch<T>& batch, Visit visit, SweepSums* sums,
                       cudaStream_t stream) {
  if (batch.begin == batch.end) {
    return;
  }
  visit_method(method, [&]<class Update>(const Update& update) {
    if (visit == Visit::all) {
      launch_all<false>(update, batch, sums, stream);
    } else if constexpr (!moves_nearly_all<Update>) {
      launch_marking(update, batch, visit, sums, stream);
    }
  });
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

template <class T>
void launch_gathering(const PointArray<T>& points, const std::int32_t* vertices, std::int32_t count,
                      PointRecord<T>* out, cudaStream_t stream) {
  if (count > 0) {
    gather<<<blocks_for(count), block_size, 0, stream>>>(points, vertices, count, out);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
}

template <class T>
void launch_arrival(const PointRecord<T>* in, const ArrivedGhosts& ghosts, const PointArray<T>& from,
                    const PointArray<T>& to, std::uint32_t* marks, cudaStream_t stream) {
  if (ghosts.count > 0) {
    arrive<<<blocks_for(ghosts.count), block_size, 0, stream>>>(in, ghosts, from, to, marks);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
}

#define INSTANTIATE(T)                                                                                          \
  template void launch_part_batch(const MethodInUse<T>&, const PartBatch<T>&, Visit, SweepSums*, cudaStream_t); \
  template void launch_gathering(const PointArray<T>&, const std::int32_t*, std::int32_t, PointRecord<T>*,      \
                                 cudaStream_t);                                                                 \
  template void launch_arrival(const PointRecord<T>*, const ArrivedGhosts&, const PointArray<T>&,               \
                               const PointArray<T>&, std::uint32_t*, cudaStream_t)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda

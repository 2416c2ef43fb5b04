// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/parts/part_batch.cuh"
#include "trismooth/cuda/runtime/thread_index.cuh"

namespace trismooth::cuda {

namespace {

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

#define INSTANTIATE(T)                                                                                     \
  TRISMOOTH_PART_BATCH(T, SlottedRingsView);                                                               \
  template void launch_gathering(const PointArray<T>&, const std::int32_t*, std::int32_t, PointRecord<T>*, \
                                 cudaStream_t);                                                            \
  template void launch_arrival(const PointRecord<T>*, const ArrivedGhosts&, const PointArray<T>&,          \
                               const PointArray<T>&, std::uint32_t*, cudaStream_t)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "trismooth/cuda/parts/part_kernels.h"
#include "trismooth/cuda/primitives/vertex_marks.cuh"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_properties.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/cuda/sweeps/grid/batch_pieces.cuh"
#include "trismooth/cuda/sweeps/grid/marked_batch.cuh"
#include "trismooth/cuda/sweeps/grid/vertex_visit.cuh"

/// Visits of a batch, for rings of either kind.
namespace trismooth::cuda {

namespace part_batch_details {

template <class T, class Rings>
__device__ SweepData<T, Rings> data_of(const PartBatch<T, Rings>& batch) {
  return {batch.rings, batch.from, batch.to, batch.next_marks, batch.tolerance};
}

template <bool marks, class Update, class T, class Rings>
__global__ void __launch_bounds__(batch_threads<Update, T, Rings>, blocks_at_once<Update, T, Rings>)
    visit_all(Update method, PartBatch<T, Rings> batch, Pieces pieces, SweepSums* sums) {
  __shared__ SweepSums shared;
  const ThreadTally<T> tally = sweep_by_blocks<marks>(method, pieces, data_of(batch));
  add_to_sums(tally, shared, sums);
}

/// Threads of a block that visits marked vertices.
constexpr int marked_threads = 256;

template <class Update, class T, class Rings>
__global__ void __launch_bounds__(marked_threads)
    visit_marked(Update method, PartBatch<T, Rings> batch, SweepSums* sums) {
  __shared__ SweepSums shared;
  __shared__ std::int32_t lists[marked_threads / 32][words_at_a_time * 32];
  ThreadTally<T> tally;
  constexpr bool all = false;
  sweep_marked<marked_threads>(method, batch.marks, all, batch.begin, batch.end, data_of(batch),
                               lists[threadIdx.x / 32], tally);
  add_to_sums(tally, shared, sums);
}

template <bool marks, class Update, class T, class Rings>
void launch_all(const Update& update, const PartBatch<T, Rings>& batch, SweepSums* sums, cudaStream_t stream) {
  const auto [blocks, pieces] = launch_of_batch<Update, T, Rings>(batch.begin, batch.end, multiprocessor_count());
  visit_all<marks><<<blocks, batch_threads<Update, T, Rings>, 0, stream>>>(update, batch, pieces, sums);
}

template <class Update, class T, class Rings>
void launch_marking(const Update& update, const PartBatch<T, Rings>& batch, Visit visit, SweepSums* sums,
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

}  // namespace part_batch_details

template <class T, class Rings>
void launch_part_batch(const MethodInUse<T>& method, const PartBatch<T, Rings>& batch, Visit visit, SweepSums* sums,
                       cudaStream_t stream) {
  if (batch.begin == batch.end) {
    return;
  }
  visit_method(method, [&]<class Update>(const Update& update) {
    if (visit == Visit::all) {
      part_batch_details::launch_all<false>(update, batch, sums, stream);
    } else if constexpr (!moves_nearly_all<Update>) {
      part_batch_details::launch_marking(update, batch, visit, sums, stream);
    }
  });
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

/// Instantiates launch_part_batch() for numbers T in rings of the template Rings.
#define TRISMOOTH_PART_BATCH(T, Rings)                                                                                \
  template void launch_part_batch(const MethodInUse<T>&, const PartBatch<T, Rings<std::int32_t>>&, Visit, SweepSums*, \
                                  cudaStream_t)

}  // namespace trismooth::cuda

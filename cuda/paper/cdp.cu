// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/paper/cdp.h"
#include "trismooth/cuda/paper/cdp_parent.cuh"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/launch.h"

namespace trismooth::cuda {

namespace {

/// Notes a launch by the device, and the error where it failed.
__device__ bool launched(LoopState* state, std::uint64_t children) {
  const cudaError_t error = cudaGetLastError();
  if (error != cudaSuccess) {
    state->error = static_cast<std::int32_t>(error);
    return false;
  }
  state->children += children;
  return true;
}

template <class Update, class Mesh>
__global__ void __launch_bounds__(parent_block_size)
    sweep_with_children(Update method, Mesh mesh, LoopRules rules, LoopState* state, SweepSums* sums) {
  __shared__ SweepSums shared;
  const bool goes_on = parent_pass(method, mesh, rules, state, sums, shared);
  // The children are to see what the whole block has written, not the launching thread alone.
  __threadfence();
  __syncthreads();
  if (threadIdx.x != 0) {
    return;
  }
  const std::int32_t buffer = state->current;
  update_triangle_qualities<<<blocks_for(mesh.triangle_count), block_size>>>(mesh, buffer);
  if (!launched(state, 1)) {
    return;
  }
  update_vertex_minima<<<blocks_for(mesh.vertex_count), block_size>>>(mesh);
  if (!launched(state, 1) || !goes_on) {
    return;
  }
  sweep_with_children<Update><<<1, parent_block_size, 0, cudaStreamTailLaunch>>>(method, mesh, rules, state, sums);
  launched(state, 0);
}

}  // namespace

bool built_with_cdp() {
  return true;
}

template <class Mesh>
void launch_cdp(Method method, const Mesh& mesh, const LoopRules& rules, LoopState* state, SweepSums* sums,
                cudaStream_t stream) {
  visit_paper_method(method, [&]<class Update>(const Update& update) {
    sweep_with_children<Update><<<1, parent_block_size, 0, stream>>>(update, mesh, rules, state, sums);
  });
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

TRISMOOTH_INSTANTIATE_FOR_PAPER(launch_cdp);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_probe.h"

namespace trismooth::cuda {

namespace {

__global__ void do_nothing() {}

}  // namespace

void probe_device() {
  cudaFuncAttributes attributes{};
  TRISMOOTH_CUDA_CHECK(cudaFuncGetAttributes(&attributes, do_nothing));
}

}  // namespace trismooth::cuda

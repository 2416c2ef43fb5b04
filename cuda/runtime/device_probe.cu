#include "trismooth/cuda/runtime/device_probe.h"
#include "trismooth/cuda/runtime/error.h"

namespace trismooth::cuda {

namespace {

__global__ void do_nothing() {}

}  // namespace

void probe_device() {
  cudaFuncAttributes attributes{};
  TRISMOOTH_CUDA_CHECK(cudaFuncGetAttributes(&attributes, do_nothing));
}

}  // namespace trismooth::cuda

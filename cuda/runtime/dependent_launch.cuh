// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime.h>

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

/// The first thing that a kernel for DependentLaunch does: it waits until all that was queued before is done and can be
/// read, and lets the next kernel come this far.
__device__ inline void wait_for_launch_before() {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 900
  cudaGridDependencySynchronize();
  cudaTriggerProgrammaticLaunchCompletion();
#endif
}

/// Launches of a kernel that begins with wait_for_launch_before(), on one stream. Its blocks are started while the
/// kernel before is still at work, and wait there (programmatic dependent launch, from compute capability 9.0 on; else
/// they are started when it is done, as always): in a chain of short kernels starting them is a quarter of the time.
template <class... Parameters>
class DependentLaunch {
 public:
  /// Throws DeviceError.
  DependentLaunch(void (*kernel)(Parameters...), cudaStream_t stream) : kernel_(kernel) {
    configuration_.stream = stream;
    attribute_.id = cudaLaunchAttributeProgrammaticStreamSerialization;
    attribute_.val.programmaticStreamSerializationAllowed = 1;
    // The code for this device that does wait.
    cudaFuncAttributes code{};
    TRISMOOTH_CUDA_CHECK(cudaFuncGetAttributes(&code, kernel));
    configuration_.numAttrs = code.ptxVersion >= 90 ? 1 : 0;
  }

  /// Throws DeviceError.
  void operator()(unsigned blocks, unsigned threads, Parameters... arguments) {
    configuration_.gridDim = dim3(blocks);
    configuration_.blockDim = dim3(threads);
    configuration_.attrs = &attribute_;
    TRISMOOTH_CUDA_CHECK(cudaLaunchKernelEx(&configuration_, kernel_, arguments...));
  }

 private:
  void (*kernel_)(Parameters...);
  cudaLaunchConfig_t configuration_{};
  cudaLaunchAttribute attribute_{};
};

}  // namespace trismooth::cuda

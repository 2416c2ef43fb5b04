// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cuda_support.h"

// The one place that knows whether the build has CUDA.
#ifdef TRISMOOTH_HAS_CUDA
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/pipeline/cuda_lines.h"
#include "trismooth/smoothing/errors.h"
#endif

namespace trismooth {

#ifdef TRISMOOTH_HAS_CUDA

namespace {

std::string device_problem() {
  try {
    cuda::require_device();
    return {};
  } catch (const DeviceError& error) {
    // Where there is no device, the survey says so in fewer words.
    const std::string problem = cuda::survey_devices().problem;
    return problem.empty() ? error.what() : problem;
  }
}

}  // namespace

CudaSupport cuda_support() {
  return {&cuda::backend(), cuda::has_cdp(), &device_problem,
          [] { return cuda_lines(cuda::survey_devices(), cuda::has_cdp()); }, &cuda::backend_on};
}

#else

CudaSupport cuda_support() {
  return {};
}

#endif

}  // namespace trismooth

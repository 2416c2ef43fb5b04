#include "trismooth/python/backends.h"

#include "trismooth/pipeline/cuda_or_cpu.h"
#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/python/errors.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::python {

namespace {

void require_cuda(const CudaSupport& cuda, const SmoothingOptions& options) {
  if (cuda.backend == nullptr) {
    throw DeviceError("backend: this build of trismooth has no CUDA; the package trismooth-cuda13 has");
  }
  if (options.execution == Execution::cdp && !cuda.has_cdp) {
    throw DeviceError("execution: this build has no CUDA dynamic parallelism; use 'resident' or 'single-block'");
  }
  if (const std::string problem = cuda.problem(); !problem.empty()) {
    throw DeviceError("backend: no CUDA device to smooth on: " + problem);
  }
}

}  // namespace

void choose_backend(const std::string& name, SmoothingOptions& options) {
  if (name != "auto" && name != "cpu" && name != "cuda") {
    raise_value_error("backend", "unknown backend '" + name + "'; valid are auto, cpu, cuda");
  }
  const bool is_unordered = options.order == Order::unordered;
  if (is_unordered && name == "cpu") {
    raise_value_error("order", "'unordered' needs the CUDA backend; the CPU smooths in order 'colour' only");
  }
  if (name == "cpu") {
    return;
  }
  static const CudaSupport cuda = cuda_support();
  if (is_unordered || name == "cuda") {
    require_cuda(cuda, options);
    options.backend = cuda.backend;
  } else if (cuda.backend != nullptr) {
    options.backend = &auto_backend();
  }
}

std::string cuda_text() {
  const CudaSupport cuda = cuda_support();
  return cuda.backend == nullptr ? std::string() : cuda.lines();
}

}  // namespace trismooth::python

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/backends.h"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

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

/// Made once, for plans use it as long as they live.
const Backend& backend_on(const CudaSupport& cuda, const std::vector<int>& devices) {
  static std::mutex making;
  static std::map<std::vector<int>, std::unique_ptr<Backend>> made;
  const std::lock_guard lock(making);
  std::unique_ptr<Backend>& backend = made[devices];
  if (backend == nullptr) {
    backend = cuda.on_devices(devices);
  }
  return *backend;
}

void choose_devices(const std::string& backend, const std::vector<int>& devices, const CudaSupport& cuda,
                    SmoothingOptions& options) {
  if (backend == "cpu") {
    raise_value_error("devices", "are CUDA's, and the backend is 'cpu'");
  }
  if (std::ranges::min(devices) < 0) {
    raise_value_error("devices", std::to_string(std::ranges::min(devices)) + " is no number of a device");
  }
  if (devices.size() > 1 && (options.order == Order::unordered || options.execution != Execution::resident)) {
    raise_value_error("devices", "order 'unordered' and the executions of the paper are for one of them");
  }
  require_cuda(cuda, options);
  options.backend = &backend_on(cuda, devices);
}

}  // namespace

void choose_backend(const std::string& name, const std::vector<int>& devices, SmoothingOptions& options) {
  if (name != "auto" && name != "cpu" && name != "cuda") {
    raise_value_error("backend", "unknown backend '" + name + "'; valid are auto, cpu, cuda");
  }
  const bool is_unordered = options.order == Order::unordered;
  if (is_unordered && name == "cpu") {
    raise_value_error("order", "'unordered' needs the CUDA backend; the CPU smooths in order 'colour' only");
  }
  static const CudaSupport cuda = cuda_support();
  if (!devices.empty()) {
    choose_devices(name, devices, cuda, options);
    return;
  }
  if (name == "cpu") {
    return;
  }
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

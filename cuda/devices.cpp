// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/devices.h"

#include <mutex>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/paper/cdp.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_probe.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

namespace {

std::string described(cudaError_t error) {
  return std::string(cudaGetErrorName(error)) + " (" + cudaGetErrorString(error) + ")";
}

DeviceInfo describe(int device) {
  DeviceInfo info;
  cudaDeviceProp properties{};
  TRISMOOTH_CUDA_CHECK(cudaGetDeviceProperties(&properties, device));
  info.name = properties.name;
  info.major = properties.major;
  info.minor = properties.minor;
  info.memory_bytes = properties.totalGlobalMem;
  info.multiprocessors = properties.multiProcessorCount;
  int current = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&current));
  TRISMOOTH_CUDA_CHECK(cudaSetDevice(device));
  std::size_t total = 0;
  const cudaError_t error = cudaMemGetInfo(&info.free_bytes, &total);
  TRISMOOTH_CUDA_CHECK(cudaSetDevice(current));
  TRISMOOTH_CUDA_CHECK(error);
  return info;
}

}  // namespace

DeviceSurvey survey_devices() {
  DeviceSurvey survey;
  // Fails only where there is no driver at all, which the next call says better.
  cudaDriverGetVersion(&survey.driver_version);
  cudaRuntimeGetVersion(&survey.runtime_version);
  int count = 0;
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess) {
    cudaGetLastError();
    survey.problem = described(error);
    return survey;
  }
  try {
    for (int device = 0; device < count; ++device) {
      survey.devices.push_back(describe(device));
    }
  } catch (const DeviceError& error) {
    survey.problem = error.what();
  }
  if (survey.devices.empty() && survey.problem.empty()) {
    survey.problem = described(cudaErrorNoDevice);
  }
  return survey;
}

const std::string& require_device() {
  static std::mutex mutex;
  static std::vector<std::string> names;  // of the devices that have answered, by number
  int count = 0;
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess || count == 0) {
    cudaGetLastError();
    throw DeviceError("CUDA: no device to smooth on: " + described(error != cudaSuccess ? error : cudaErrorNoDevice) +
                      "; use '--backend cpu', or install a driver for CUDA 13 or newer");
  }
  int device = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDevice(&device));
  const std::lock_guard lock(mutex);
  names.resize(static_cast<std::size_t>(count));
  std::string& name = names[static_cast<std::size_t>(device)];
  if (name.empty()) {
    probe_device();
    name = describe(device).name;
  }
  return name;
}

bool has_cdp() {
  return built_with_cdp();
}

}  // namespace trismooth::cuda

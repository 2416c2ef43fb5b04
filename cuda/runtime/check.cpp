// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/check.h"

#include <string>
#include <string_view>

#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

void check(cudaError_t error, const char* call, const char* file, int line) {
  if (error == cudaSuccess) {
    return;
  }
  // The runtime keeps the error of a failed launch until somebody asks for it; the next call is not to blame.
  cudaGetLastError();
  const std::string_view path(file);
  const std::string_view name = path.substr(path.find_last_of('/') + 1);
  throw DeviceError("CUDA: " + std::string(cudaGetErrorName(error)) + " (" + cudaGetErrorString(error) + ") from " +
                    call + " at cuda/" + std::string(name) + ":" + std::to_string(line) +
                    (error == cudaErrorMemoryAllocation ? "; use a device with more memory, or '--backend cpu'" : ""));
}

}  // namespace trismooth::cuda

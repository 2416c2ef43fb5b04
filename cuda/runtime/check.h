// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime_api.h>

namespace trismooth::cuda {

/// Throws DeviceError with the error's name and text, the call, and where it stands, unless `error` is cudaSuccess.
void check(cudaError_t error, const char* call, const char* file, int line);

}  // namespace trismooth::cuda

/// Every call of the CUDA runtime goes through this.
#define TRISMOOTH_CUDA_CHECK(call) ::trismooth::cuda::check((call), #call, __FILE__, __LINE__)

// SPDX-License-Identifier: BSD-3-Clause
// The main of test programs that need a device. Where there is none they say so and exit with 77: skipped, not passed.

#include <cstdio>

#include <cuda_runtime_api.h>

#include "catch_main.h"

int main(int argc, char** argv) {
  constexpr int skipped = 77;
  int devices = 0;
  const cudaError_t error = cudaGetDeviceCount(&devices);
  if (error != cudaSuccess || devices == 0) {
    std::printf("skipped: %s\n", error == cudaSuccess ? "no CUDA device" : cudaGetErrorString(error));
    return skipped;
  }
  return run_catch(argc, argv);
}

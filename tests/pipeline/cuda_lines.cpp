// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cuda_lines.h"

#include "trismooth/cuda/devices.h"

#include "catch.h"

namespace trismooth::cuda_lines_test {

using cuda::DeviceSurvey;

constexpr std::size_t gibibyte = std::size_t{1} << 30U;

TEST_CASE("each device is listed with what decides whether a mesh fits and a build runs") {
  DeviceSurvey survey;
  survey.runtime_version = 13000;
  survey.driver_version = 12090;
  survey.devices = {{"NVIDIA H200", 9, 0, 140 * gibibyte, 139 * gibibyte, 132}, {"Other", 8, 6, gibibyte, 0, 1}};
  CHECK(cuda_lines(survey, true) ==
        "CUDA:       runtime 13.0, driver for 12.9, with dynamic parallelism (--execution cdp)\n"
        "device 0:   NVIDIA H200, compute capability 9.0, 140.0 GiB (139.0 GiB free), 132 multiprocessors\n"
        "device 1:   Other, compute capability 8.6, 1.0 GiB (0.00 MiB free), 1 multiprocessors\n");
}

TEST_CASE("where there is no device, the reason is given") {
  DeviceSurvey survey;
  survey.runtime_version = 13010;
  survey.problem = "cudaErrorInsufficientDriver (CUDA driver version is insufficient for CUDA runtime version)";
  CHECK(cuda_lines(survey, false) ==
        "CUDA:       runtime 13.1, no driver, without dynamic parallelism (no --execution cdp)\n"
        "no device:  cudaErrorInsufficientDriver (CUDA driver version is insufficient for CUDA runtime version)\n");
}

}  // namespace trismooth::cuda_lines_test

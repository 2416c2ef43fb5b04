// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trismooth::cuda {

/// A CUDA device of this machine.
struct DeviceInfo {
  std::string name;
  int major = 0;  ///< compute capability
  int minor = 0;
  std::size_t memory_bytes = 0;
  std::size_t free_bytes = 0;
  int multiprocessors = 0;
};

/// What CUDA finds on this machine.
struct DeviceSurvey {
  std::vector<DeviceInfo> devices;
  std::string problem;     ///< why there are none, or not all, with the CUDA error's name; else empty
  int driver_version = 0;  ///< CUDA version of the driver, as 1000 major + 10 minor; 0: no driver
  int runtime_version = 0;
};

/// Looks for devices. Never throws: a driver that is missing or too old is a problem to report, no error.
DeviceSurvey survey_devices();

/// Whether this build has the CUDA dynamic parallelism version.
bool has_cdp();

/// Throws DeviceError where there is no device to run on, or none that this build was compiled for. Returns the name of
/// the current device.
const std::string& require_device();

}  // namespace trismooth::cuda

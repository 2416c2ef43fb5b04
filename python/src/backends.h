// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/smoothing/options.h"

namespace trismooth::python {

/// Sets options.backend to the one of that name, "auto", "cpu" or "cuda", as the program does; `devices`, if there are
/// any, are those of the CUDA backend, which "auto" is then. Raises ValueError for another name or where options need
/// another backend; throws DeviceError where the build has no CUDA or the machine no such device.
void choose_backend(const std::string& name, const std::vector<int>& devices, SmoothingOptions& options);

/// What the build has of CUDA and finds on this machine, as lines for people; empty in a build without.
std::string cuda_text();

}  // namespace trismooth::python

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "trismooth/smoothing/backend.h"

namespace trismooth {

/// What the pipeline knows of CUDA, in a build with it or without. Tests hand in one of their own.
struct CudaSupport {
  const Backend* backend = nullptr;  ///< null: this build has none, and the rest means nothing
  bool has_cdp = false;              ///< Execution::cdp is built in
  /// Why no device can be used, with the CUDA error's name; empty where one can.
  std::function<std::string()> problem;
  /// What was found, for `trismooth info`: see cuda_lines().
  std::function<std::string()> lines;
  /// The backend for devices by number, which share out every mesh: cuda::backend_on().
  std::function<std::unique_ptr<Backend>(std::span<const int>)> on_devices = {};
};

/// That of this build. Asks no driver before `problem` or `lines` are called.
CudaSupport cuda_support();

}  // namespace trismooth

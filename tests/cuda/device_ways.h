// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "trismooth/cuda/devices.h"
#include "trismooth/smoothing/options.h"

/// The ways to sweep on a device that this build has.
namespace device_ways {

/// An execution in a layout that it has.
struct DeviceWay {
  trismooth::Execution execution;
  trismooth::Layout layout;

  void choose_in(trismooth::SmoothingOptions& options) const {
    options.execution = execution;
    options.layout = layout;
  }
};

/// The paper's versions, in both layouts.
inline std::vector<DeviceWay> paper_ways() {
  using trismooth::Execution;
  using trismooth::Layout;
  std::vector<DeviceWay> ways{{Execution::single_block, Layout::aos}, {Execution::single_block, Layout::soa}};
  if (trismooth::cuda::has_cdp()) {
    ways.push_back({Execution::cdp, Layout::aos});
    ways.push_back({Execution::cdp, Layout::soa});
  }
  return ways;
}

/// Whether the paper's versions have this method.
inline bool is_of_paper(trismooth::Method method) {
  return method == trismooth::Method::smart || method == trismooth::Method::laplacian;
}

/// All that there are for a method.
inline std::vector<DeviceWay> every_way(trismooth::Method method) {
  std::vector<DeviceWay> ways = is_of_paper(method) ? paper_ways() : std::vector<DeviceWay>{};
  ways.push_back({trismooth::Execution::resident, trismooth::Layout::aos});
  return ways;
}

}  // namespace device_ways

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

/// All.
inline std::vector<DeviceWay> every_way() {
  std::vector<DeviceWay> ways = paper_ways();
  ways.push_back({trismooth::Execution::resident, trismooth::Layout::aos});
  return ways;
}

}  // namespace device_ways

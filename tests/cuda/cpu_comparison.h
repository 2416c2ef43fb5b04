// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/smoothing/options.h"

#include "catch.h"
#include "device_ways.h"
#include "smoothing_runs.h"

/// The CUDA backend held to the CPU's.
namespace cpu_comparison {

using namespace smoothing_runs;

inline std::vector<Execution> built_executions() {
  std::vector<Execution> built{Execution::resident, Execution::single_block};
  if (cuda::has_cdp()) {
    built.push_back(Execution::cdp);
  }
  return built;
}

/// Every way to sweep, with either topology, against the CPU.
inline void require_cpu_results(const Mesh& mesh, SmoothingOptions options, const Constraints& constraints = {},
                                Storage storage = Storage::float64) {
  const Run expected = run(mesh, options, constraints, storage);
  options.backend = &cuda::backend();
  for (const device_ways::DeviceWay& way : device_ways::every_way(options.method)) {
    for (const Topology topology : {Topology::host, Topology::device}) {
      way.choose_in(options);
      options.topology = topology;
      CAPTURE(to_string(way.execution), to_string(way.layout), to_string(topology));
      require_same(run(mesh, options, constraints, storage), expected);
    }
  }
}

inline SmoothingOptions on_cuda(Execution execution = Execution::resident) {
  SmoothingOptions options;
  options.backend = &cuda::backend();
  options.execution = execution;
  return options;
}

}  // namespace cpu_comparison

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "trismooth/paper/experiment.h"

/// Results of experiments that nobody made, for tests of what is concluded from them.
namespace sample {

using trismooth::Form;
using trismooth::Layout;
using trismooth::Order;
using trismooth::Spread;
using trismooth::experiments::Case;
using trismooth::experiments::ExperimentResult;
using trismooth::experiments::Measurement;
using trismooth::experiments::Version;

/// The milliseconds of smoothing of a case on a mesh; nothing where it was not measured.
using Times = std::function<std::optional<Spread>(std::int64_t vertices, const Case& what)>;

inline Spread exactly(double value) {
  return {value, value, value};
}

/// Each row has 0.25 ms of topology, and on a device 0.5 ms of transfer. Form A takes 100 sweeps, Form B 50, unordered
/// 75 to 85.
inline ExperimentResult experiment(
    const std::vector<std::int64_t>& sizes, const Times& times,
    const std::vector<Version>& versions = trismooth::experiments::ExperimentOptions{}.versions) {
  ExperimentResult result;
  result.options.sizes = sizes;
  result.options.versions = versions;
  for (const std::int64_t size : sizes) {
    result.meshes.push_back({size, size, 2 * size});
    for (const Case& what : trismooth::experiments::cases_of(versions)) {
      trismooth::experiments::Row row{size, what};
      if (const auto time = times(size, what)) {
        const double transfer = runs_on_device(what.version) ? 0.5 : 0;
        Measurement measured;
        measured.runs = result.options.runs;
        measured.topology = exactly(0.25);
        measured.transfer = exactly(transfer);
        measured.smoothing = *time;
        measured.together = {time->median + 0.25 + transfer, time->least + 0.25 + transfer,
                             time->most + 0.25 + transfer};
        measured.sweeps = what.form == Form::swap          ? exactly(100)
                          : what.order == Order::unordered ? Spread(80, 75, 85)
                                                           : exactly(50);
        measured.stop_reason = trismooth::StopReason::tolerance;
        measured.vertex_updates = 12 * size;
        measured.free_vertices = size - 20;
        measured.threads = runs_on_device(what.version) ? 0 : what.version == Version::cpu ? 4 : 1;
        measured.device = runs_on_device(what.version) ? "A <fast> GPU" : "A processor";
        measured.coordinates_hash = "0123456789abcdef";
        row.measured = measured;
      } else {
        row.lack = trismooth::experiments::Lack::device;
        row.missing_reason = "no device: for a <test>";
      }
      result.rows.push_back(row);
    }
  }
  return result;
}

/// Every case at its own pace, linear in the size: SoA takes 1.25 times as long as AoS, Form A twice as long as Form B.
inline std::optional<Spread> regular_time(std::int64_t vertices, const Case& what) {
  const double of_version = what.version == Version::serial ? 40
                            : what.version == Version::cpu  ? 10
                            : what.version == Version::gpu  ? 8
                            : what.version == Version::cdp  ? 4
                                                            : 0.25;
  const double time = of_version * static_cast<double>(vertices) / 1000 * (what.form == Form::swap ? 2 : 1) *
                      (what.layout == Layout::soa ? 1.25 : 1);
  return Spread(time, time * 0.875, time * 1.125);
}

/// The same without a device.
inline std::optional<Spread> cpu_time(std::int64_t vertices, const Case& what) {
  return runs_on_device(what.version) ? std::nullopt : regular_time(vertices, what);
}

}  // namespace sample

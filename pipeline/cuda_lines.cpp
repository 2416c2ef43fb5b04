// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cuda_lines.h"

#include <fmt/format.h>

#include "trismooth/cuda/devices.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth {

namespace {

std::string version_text(int version) {
  return fmt::format("{}.{}", version / 1000, version % 1000 / 10);
}

std::string device_text(const cuda::DeviceInfo& device) {
  return fmt::format("{}, compute capability {}.{}, {} ({} free), {} multiprocessors", device.name, device.major,
                     device.minor, bytes_text(static_cast<std::int64_t>(device.memory_bytes)),
                     bytes_text(static_cast<std::int64_t>(device.free_bytes)), device.multiprocessors);
}

}  // namespace

std::string cuda_lines(const cuda::DeviceSurvey& survey, bool has_cdp) {
  std::string lines = fmt::format(
      "CUDA:       runtime {}, {}, {}\n", version_text(survey.runtime_version),
      survey.driver_version == 0 ? "no driver" : "driver for " + version_text(survey.driver_version),
      has_cdp ? "with dynamic parallelism (--execution cdp)" : "without dynamic parallelism (no --execution cdp)");
  for (std::size_t i = 0; i < survey.devices.size(); ++i) {
    lines += fmt::format("{:<12}{}\n", fmt::format("device {}:", i), device_text(survey.devices[i]));
  }
  if (!survey.problem.empty()) {
    lines += fmt::format("{:<12}{}\n", survey.devices.empty() ? "no device:" : "more fail:", survey.problem);
  }
  return lines;
}

}  // namespace trismooth

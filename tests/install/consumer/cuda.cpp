// SPDX-License-Identifier: BSD-3-Clause
// The component cuda: what it finds on this machine, which may be nothing.
#include <cstdio>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/smoothing/options.h"

int main() {
  const trismooth::cuda::DeviceSurvey survey = trismooth::cuda::survey_devices();
  trismooth::SmoothingOptions options;
  options.backend = &trismooth::cuda::backend();
  std::printf("%zu devices %s\n", survey.devices.size(), survey.problem.c_str());
  return survey.devices.empty() == survey.problem.empty() ? 1 : 0;
}

// SPDX-License-Identifier: BSD-3-Clause
// The component pipeline: from the file that is named to the one that is named second, with a gate and a report.
#include "trismooth/pipeline/pipeline.h"

#include <cstdio>

#include "trismooth/pipeline/auto_backend.h"
#include "trismooth/pipeline/gates.h"
#include "trismooth/pipeline/report/html_report.h"
#include "trismooth/pipeline/report/json_report.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    return 2;
  }
  trismooth::PipelineOptions options;
  options.input = argv[1];
  options.output = argv[2];
  const trismooth::PipelineResult result = trismooth::run_pipeline(options);
  const double before = result.before[trismooth::Metric::shape].min;
  const double after = result.after.value()[trismooth::Metric::shape].min;
  std::printf("smallest shape %g -> %g\n", before, after);
  const trismooth::GateOutcome gate = trismooth::check_gate(trismooth::parse_gate("min_shape>0"), result.after.value());
  const bool has_reports =
      trismooth::json_report(options, result, {.gates = {gate}}).find("min_shape") != std::string::npos &&
      trismooth::html_report(options, result).find("<html") != std::string::npos;
  return after > before && gate.passed && has_reports ? 0 : 1;
}

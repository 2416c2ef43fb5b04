// The component pipeline: from the file that is named to the one that is named second.
#include "trismooth/pipeline/pipeline.h"

#include <cstdio>

#include "trismooth/pipeline/auto_backend.h"

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
  return after > before ? 0 : 1;
}

#include "trismooth/pipeline/stages/read_stage.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/stages/run_state.h"

namespace trismooth {

void read_input(RunState& run) {
  const PipelineOptions& options = run.options;
  MeshDocument& document = run.document;
  PipelineResult& result = run.result;
  document = read_mesh(options.input, FileOptions{options.smoothing.threads, options.format});
  // What the reader says of the file is said of what another format loses.
  const bool converts =
      options.output && output_format(*options.output, document.format, options.format) != document.format;
  take_input(run);
  std::ranges::copy(document.notes, std::back_inserter(converts ? result.losses : result.notes));
}

void take_input(RunState& run) {
  const MeshDocument& document = run.document;
  PipelineResult& result = run.result;
  result.losses = document.losses;
  result.input.path = shown_input(run.options.input);
  result.input.format = document.format;
  result.input.vertices = static_cast<std::int64_t>(document.point_count());
}

}  // namespace trismooth

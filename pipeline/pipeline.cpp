#include "trismooth/pipeline/pipeline.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <future>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "trismooth/base/machine/peak_memory.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/annotations.h"
#include "trismooth/pipeline/document_run.h"
#include "trismooth/pipeline/stages/check_stage.h"
#include "trismooth/pipeline/stages/read_stage.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/pipeline/stages/smooth_stage.h"
#include "trismooth/pipeline/stages/topology_stage.h"
#include "trismooth/pipeline/stages/warnings.h"
#include "trismooth/pipeline/stages/write_stage.h"
#include "trismooth/smoothing/backend.h"

namespace trismooth {

namespace {

/// A device starts while the file is read, if that takes long enough to be worth a thread.
std::future<void> start_backend(const PipelineOptions& options) {
  constexpr std::uintmax_t bytes_worth_a_thread = std::uintmax_t{1} << 20;
  constexpr std::uintmax_t bytes_of_vertex = 64;  // what a vertex and its two triangles take in a file, about
  std::error_code no_size;
  const std::uintmax_t bytes = std::filesystem::file_size(options.input, no_size);
  const Backend* const backend = options.smoothing.backend;
  if (backend == nullptr || !options.output || no_size || bytes < bytes_worth_a_thread) {
    return {};
  }
  const auto vertices = static_cast<std::int64_t>(bytes / bytes_of_vertex);
  // Where the system refuses a thread this is put off for ever, which does no harm.
  return std::async(std::launch::async | std::launch::deferred, [backend, vertices] { backend->start(vertices); });
}

/// One run over one file: the stages in their order, each with its time.
class Run {
 public:
  explicit Run(const PipelineOptions& options) : options_(options), state_(options) {
    options_.smoothing.validate();
    options_.slide.validate();
  }

  PipelineResult run() {
    require_known_formats(options_);
    starting_ = start_backend(options_);
    timed(Stage::read, state_.result.timings_ms.read, read_input);
    check_and_smooth();
    write();
    return std::move(state_.result);
  }

  /// The stages behind reading.
  PipelineResult run_from(MeshDocument document) {
    state_.document = std::move(document);
    take_input(state_);
    check_and_smooth();
    write();
    return std::move(state_.result);
  }

  /// The stages between reading and writing, on `document`, which is as it was where they fail. `annotations`, where it
  /// is not null, gets those that the options want.
  PipelineResult run_on(MeshDocument& document, AddedArrays* annotations = nullptr) {
    const std::vector<double> points = document.points;
    const std::vector<DataArray> point_arrays = document.point_arrays;
    state_.document = std::move(document);
    take_input(state_);
    const bool annotates = annotations != nullptr && (options_.annotate || options_.annotated);
    const bool drops = options_.output || annotates;
    try {
      check_and_smooth();
      if (annotates) {
        *annotations = annotations_of(state_);
      } else if (const auto dropped = annotations_in(state_.document); drops && !dropped.empty()) {
        state_.note(note_of_dropped_annotations(dropped));
      }
      complete();
      if (options_.beside.prepare) {
        options_.beside.prepare(state_.result);
      }
    } catch (...) {
      document = std::move(state_.document);
      document.points = points;
      document.point_arrays = point_arrays;
      throw;
    }
    if (drops) {
      drop_annotations(state_.document);
    }
    if (options_.output) {
      std::ranges::move(state_.stage_arrays, std::back_inserter(state_.document.point_arrays));
    }
    document = std::move(state_.document);
    return std::move(state_.result);
  }

 private:
  /// The mesh and what belongs to it: first complete under other names, then put in place, the mesh last. Completes the
  /// result.
  void write() {
    std::optional<WrittenAside> mesh;
    if (const auto& path = options_.written()) {
      timed(Stage::write, state_.result.timings_ms.write,
            [&](RunState& run) { mesh.emplace(write_output(run, *path, !options_.output || options_.annotate)); });
    }
    complete();
    if (!mesh) {
      return;
    }
    if (options_.beside.prepare) {
      options_.beside.prepare(state_.result);
    }
    mesh->send();
    if (options_.beside.place) {
      options_.beside.place();
    }
    mesh->commit();
  }

  void check_and_smooth() {
    PipelineTimings& timings = state_.result.timings_ms;
    timed(Stage::topology, timings.topology, connect_mesh);
    timed(Stage::check_before, timings.check_before, check_before);
    if (options_.output) {
      warn_before_smoothing(state_);
      begin(Stage::smooth);
      smooth_mesh(state_);
      timed(Stage::check_after, timings.check_after, check_after);
    }
  }

  void complete() {
    state_.result.timings_ms.total = watch_.milliseconds();
    state_.result.peak_memory_bytes = peak_memory_bytes();
  }

  void begin(Stage stage) const {
    if (options_.stage_started && options_.stage_started(stage) == Progress::stop) {
      throw Cancelled();
    }
  }

  template <class Body>
  void timed(Stage stage, double& milliseconds, const Body& body) {
    begin(stage);
    const Stopwatch watch;
    body(state_);
    milliseconds += watch.milliseconds();
  }

  const Stopwatch watch_;
  const PipelineOptions& options_;
  std::future<void> starting_;  ///< the backend
  RunState state_;
};

}  // namespace

void require_known_formats(const PipelineOptions& options) {
  const auto& output = options.written();
  if (names_parallel_file(options.input)) {
    throw ReadError(options.input,
                    "is a mesh in pieces, which 'trismooth smooth' and 'quality' read where they are built with MPI "
                    "(-DTRISMOOTH_MPI=ON)");
  }
  if (output && names_parallel_file(*output)) {
    throw WriteError(*output,
                     "is the name of a mesh in pieces, which 'trismooth smooth' writes where it is built with MPI "
                     "(-DTRISMOOTH_MPI=ON)");
  }
  const auto says_nothing = [&options](const std::filesystem::path& path) {
    return !options.format && !is_standard_stream(path) && !format_of(path);
  };
  if (output && says_nothing(options.input) && says_nothing(*output)) {
    throw ReadError(options.input, "the extension '" + extension_of(options.input) +
                                       "' names no format, nor does that of the output, " + output->string() +
                                       "; known are " + titled_format_list());
  }
  if (format_of(options.input)) {
    input_format(options.input);
  }
  if (output && !is_standard_stream(*output)) {
    output_format(*output, std::nullopt, options.format);
  }
}

PipelineResult run_pipeline(const PipelineOptions& options) {
  return Run(options).run();
}

PipelineResult run_pipeline_on(MeshDocument document, const PipelineOptions& options) {
  return Run(options).run_from(std::move(document));
}

PipelineResult run_on_document(MeshDocument& document, const PipelineOptions& options, AddedArrays& annotations) {
  return Run(options).run_on(document, &annotations);
}

PipelineResult smooth_document(MeshDocument& document, const PipelineOptions& options) {
  PipelineOptions own = options;
  own.output = std::filesystem::path("document").replace_extension(extensions_of(document.format).front());
  own.format = document.format;
  return Run(own).run_on(document);
}

PipelineResult check_document(MeshDocument& document, const PipelineOptions& options) {
  PipelineOptions own = options;
  own.output.reset();
  return Run(own).run_on(document);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/pipeline.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <future>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/annotations.h"
#include "trismooth/pipeline/document_run.h"
#include "trismooth/pipeline/stages/document_mesh.h"
#include "trismooth/pipeline/stages/staged_run.h"
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

/// A run over a mesh that is a document of this process.
class DocumentRun {
 public:
  explicit DocumentRun(const PipelineOptions& options) : mesh_(options), stages_(mesh_) {}

  PipelineResult run() {
    require_known_formats(run_.options);
    [[maybe_unused]] const std::future<void> starting = start_backend(run_.options);
    stages_.read();
    return finish();
  }

  /// The stages behind reading.
  PipelineResult run_from(MeshDocument document) {
    mesh_.take(std::move(document));
    return finish();
  }

  /// The stages between reading and writing, on `document`, which is as it was where they fail. `annotations`, where it
  /// is not null, gets those that the options want.
  PipelineResult run_on(MeshDocument& document, AddedArrays* annotations = nullptr) {
    const PipelineOptions& options = run_.options;
    if (options.deformation) {
      throw std::invalid_argument("deformation: is for run_pipeline(); of points in memory MovingMesh has them follow");
    }
    if (options.compared) {
      throw std::invalid_argument("compared: is for run_pipeline(), which reads both meshes");
    }
    const std::vector<double> points = document.points;
    const std::vector<DataArray> point_arrays = document.point_arrays;
    mesh_.take(std::move(document));
    const bool annotates = annotations != nullptr && (options.annotate || options.annotated);
    const bool drops = options.output || annotates;
    try {
      stages_.check_and_smooth();
      if (annotates) {
        *annotations = annotations_of(run_);
      } else if (const auto dropped = annotations_in(run_.document); drops && !dropped.empty()) {
        run_.note(note_of_dropped_annotations(dropped));
      }
      stages_.complete();
      if (options.beside.prepare) {
        options.beside.prepare(run_.result);
      }
    } catch (...) {
      document = std::move(run_.document);
      document.points = points;
      document.point_arrays = point_arrays;
      throw;
    }
    if (drops) {
      drop_annotations(run_.document);
    }
    if (options.output) {
      std::ranges::move(run_.stage_arrays, std::back_inserter(run_.document.point_arrays));
    }
    document = std::move(run_.document);
    return std::move(run_.result);
  }

 private:
  PipelineResult finish() {
    if (run_.options.deformation) {
      follow_boundary();
    } else if (run_.options.compared) {
      stages_.check();
      stages_.compare([this] { mesh_.compare(); });
      stages_.complete();
    } else {
      stages_.check_and_smooth();
      stages_.write();
    }
    return std::move(run_.result);
  }

  void follow_boundary() {
    stages_.check();
    Deformer& deformer = mesh_.deform();
    while (!deformer.is_done()) {
      stages_.smooth();
      deformer.step_checked();
      stages_.write();
    }
  }

  DocumentMesh mesh_;
  StagedRun stages_;
  RunState& run_ = mesh_.state();
};

/// Options for a mesh in memory. Throws MeshError where require_sound() does.
PipelineOptions options_for(const MeshDocument& document, PipelineOptions options) {
  require_sound(document);
  if (options.input.empty()) {
    options.input = "the mesh";
  }
  return options;
}

}  // namespace

void require_known_formats(const PipelineOptions& options) {
  const auto& output = options.written();
  for (const auto& input : {std::optional(options.input), options.compared}) {
    if (input && names_parallel_file(*input)) {
      throw ReadError(*input,
                      "is a mesh in pieces, which 'trismooth smooth' and 'quality' read where they are built with MPI "
                      "(-DTRISMOOTH_MPI=ON)");
    }
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
                                       "; known are " + format_list());
  }
  for (const auto& input : {std::optional(options.input), options.compared}) {
    if (input && format_of(*input)) {
      input_format(*input);
    }
  }
  if (output && !is_standard_stream(*output)) {
    output_format(*output, std::nullopt, options.format);
  }
}

PipelineResult run_pipeline(const PipelineOptions& options) {
  return DocumentRun(options).run();
}

PipelineResult run_pipeline_on(MeshDocument document, const PipelineOptions& options) {
  return DocumentRun(options).run_from(std::move(document));
}

PipelineResult run_on_document(MeshDocument& document, const PipelineOptions& options, AddedArrays& annotations) {
  return DocumentRun(options).run_on(document, &annotations);
}

PipelineResult smooth_document(MeshDocument& document, const PipelineOptions& options) {
  PipelineOptions own = options_for(document, options);
  own.output = std::filesystem::path("document").replace_extension(extensions_of(document.format).front());
  own.format = document.format;
  return DocumentRun(own).run_on(document);
}

PipelineResult check_document(MeshDocument& document, const PipelineOptions& options) {
  PipelineOptions own = options_for(document, options);
  own.output.reset();
  return DocumentRun(own).run_on(document);
}

}  // namespace trismooth

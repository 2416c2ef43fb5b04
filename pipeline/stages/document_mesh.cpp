// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/document_mesh.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "trismooth/base/machine/peak_memory.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/stages/compare_stage.h"
#include "trismooth/pipeline/stages/picture_stage.h"
#include "trismooth/pipeline/stages/smooth_stage.h"
#include "trismooth/pipeline/stages/topology_stage.h"
#include "trismooth/pipeline/stages/write_stage.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/size_ratio.h"

namespace trismooth {

namespace {

QualityReport report_of(const RunState& run) {
  QualityReport report = quality_report(run.view(), {.threads = run.options.smoothing.threads});
  if (run.options.size_ratio) {
    report.size_ratio = size_ratio_summary(run.view(), run.options.smoothing.threads);
  }
  report.degenerate += run.mesh.repeating.triangles;
  report.inverted += run.mesh.crossed_quads;
  for (WorstElement& element : report.worst) {
    const auto corners = run.mesh.elements[static_cast<std::size_t>(element.element)];
    if (run.regions.count() > 1) {
      element.region = run.regions.of_triangle[static_cast<std::size_t>(element.element)];
    }
    element.all_fixed = all_are_fixed(corners, run.found.fixed);
    element.element = run.mesh.cells[static_cast<std::size_t>(element.element)];
    element.centroid = run.local.frame.leave(element.centroid);
    if (run.mesh.map) {
      element.centroid = run.mesh.map->degrees(element.centroid);
    }
  }
  return report;
}

std::vector<RegionQuality> quality_of_regions(const RunState& run) {
  const std::int32_t count = run.regions.count();
  return count < 2 ? std::vector<RegionQuality>{}
                   : region_quality(run.view(), run.regions.of_triangle, count, run.options.smoothing.threads);
}

std::optional<QuadraticQuality> quality_of_quadratics(const RunState& run) {
  return run.mesh.quadratics.empty()
             ? std::nullopt
             : std::optional(quadratic_quality(run.view(), run.mesh.quadratics, run.options.smoothing.threads));
}

}  // namespace

std::int64_t DocumentMesh::peak_memory() const {
  return peak_memory_bytes();
}

void DocumentMesh::read() {
  const PipelineOptions& options = run_.options;
  take(read_mesh(options.input, FileOptions{options.smoothing.threads, options.format}));
  // What the reader says of the file is said of what another format loses.
  const FileFormat format = run_.document.format;
  const bool converts = options.output && output_format(*options.output, format, options.format) != format;
  std::ranges::copy(run_.document.notes, std::back_inserter(converts ? run_.result.losses : run_.result.notes));
  if (options.compared) {
    compared_ = read_compared(run_);
  }
}

void DocumentMesh::take(MeshDocument document) {
  run_.document = std::move(document);
  run_.result.losses = run_.document.losses;
  run_.result.input.path = shown_input(run_.options.input);
  run_.result.input.format = run_.document.format;
  run_.result.input.vertices = static_cast<std::int64_t>(run_.document.point_count());
}

void DocumentMesh::connect() {
  connect_mesh(run_);
}

QualityOfMesh DocumentMesh::quality() {
  return {report_of(run_), quality_of_regions(run_), quality_of_quadratics(run_)};
}

PrecisionLoss DocumentMesh::precision_loss() {
  return single_precision_loss(run_.view(), run_.options.smoothing.threads);
}

CoarseBoundary DocumentMesh::coarse_boundary() {
  return find_coarse_boundary(run_.view(), run_.found.fixed, run_.options.smoothing.threads);
}

Deformer& DocumentMesh::deform() {
  deformer_ = std::make_unique<Deformer>(run_);
  return *deformer_;
}

void DocumentMesh::compare() {
  compare_meshes(run_, compared_);
}

SmoothingResult DocumentMesh::smooth() {
  SmoothingResult smoothing = deformer_ ? deformer_->follow() : smooth_mesh(run_);
  stop_if_cancelled(smoothing);
  return smoothing;
}

void DocumentMesh::keep_picture() {
  trismooth::keep_picture(run_);
}

void DocumentMesh::write(const std::function<const PipelineResult&()>& completed) {
  const PipelineOptions& options = run_.options;
  const std::size_t notes = run_.result.notes.size();
  const std::size_t losses = run_.result.losses.size();
  const std::filesystem::path path = deformer_ ? deformer_->output() : *options.written();
  WrittenAside mesh = write_output(run_, path, !options.output || options.annotate);
  std::ranges::move(mesh.others(path), std::back_inserter(run_.result.other_outputs));
  if (deformer_ && deformer_->done() > 1) {
    // What is to be said of the file has been said of the first one.
    run_.result.notes.resize(notes);
    run_.result.losses.resize(losses);
  }
  const bool is_last = !deformer_ || deformer_->is_done();
  const PipelineResult& result = completed();
  if (is_last && options.beside.prepare) {
    options.beside.prepare(result);
  }
  mesh.commit_before(is_last ? options.beside.place : nullptr);
}

}  // namespace trismooth

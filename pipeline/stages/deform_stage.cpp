// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/deform_stage.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/stages/stored_result.h"
#include "trismooth/pipeline/stages/warnings.h"
#include "trismooth/pipeline/stages/write_stage.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/size_change.h"
#include "trismooth/smoothing/commit.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/result_text.h"

namespace trismooth {

namespace {

using FilePoint = Eigen::Map<const Eigen::Vector3d>;

MovingMesh moving_mesh_of(const RunState& run) {
  try {
    return {run.mesh.points, IndexView(run.mesh.elements), {.fixed = run.found.fixed}, run.smoothing};
  } catch (const MeshError& error) {
    throw ReadError(run.options.input, error.what());
  }
}

/// Who goes where it is told.
std::vector<Obeys> who_obeys(const RunState& run) {
  constexpr std::int32_t none = -1;
  const PlanarMesh& mesh = run.mesh;
  std::vector<Obeys> obeys(mesh.points.size(), Obeys::never);
  for (std::size_t v = 0; v < obeys.size(); ++v) {
    const std::uint8_t held = run.found.fixed[v];
    obeys[v] = held == 0 ? Obeys::never : hold::is_unused(held) ? Obeys::if_told : Obeys::always;
  }
  // Middles follow their sides, but where a side is not between two elements of one region they may be told; centres
  // follow their corners.
  for (const MiddleNode& middle : mesh.middles) {
    obeys[middle.vertex] = Obeys::never;
  }
  std::vector<std::int32_t> first_element(mesh.middles.empty() ? 0 : mesh.points.size(), none);
  const auto region_of = [&](std::int32_t element) {
    return run.regions.of_triangle.empty() ? 0 : run.regions.of_triangle[element];
  };
  for (const QuadraticElement& quadratic : mesh.quadratics) {
    for (const std::int32_t middle : std::span(quadratic.middles).first(mesh.elements[quadratic.element].size())) {
      if (middle == no_corner || obeys[middle] == Obeys::always) {
        continue;  // held by itself
      }
      std::int32_t& first = first_element[middle];
      const bool is_on_boundary = first == none || region_of(first) != region_of(quadratic.element);
      obeys[middle] = is_on_boundary ? Obeys::if_told : Obeys::never;
      first = quadratic.element;
    }
  }
  return obeys;
}

/// The quadrilaterals that are held, and valid in the file, counter-clockwise.
std::vector<MixedElement> valid_held_quads(const RunState& run) {
  std::vector<MixedElement> valid;
  if (run.mesh.held_quads == 0) {
    return valid;
  }
  const CellList& cells = run.document.cells;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (const auto quad = quad_of_cell(cells.types[cell], cells[cell])) {
      const auto& [a, b, c, d] = quad->corners;
      for (const MixedElement& corners : {MixedElement{a, b, c, d}, MixedElement{a, d, c, b}}) {
        if (shape_quotient(points_of(corners, run.local.points)) > 0) {
          valid.push_back(corners);
        }
      }
    }
  }
  return valid;
}

}  // namespace

Deformer::Deformer(RunState& run)
    : run_(run),
      file_points_(run.document.points),
      file_places_(run.mesh.points),
      file_local_(run.local),
      obeys_(who_obeys(run)),
      valid_quads_(valid_held_quads(run)),
      moving_(moving_mesh_of(run)) {
  if (run.options.annotate) {
    run.input_points = file_points_;
    run.metrics_before = metrics_of_cells(run, "_before");
  }
}

std::filesystem::path Deformer::output() const {
  const Deformation& asked = *run_.options.deformation;
  return asked.is_series ? output_of_step(*run_.options.output, done_ - 1, asked.step_count()) : *run_.options.output;
}

const std::filesystem::path& Deformer::file_of_step(std::size_t step) const {
  const std::vector<std::filesystem::path>& files = run_.options.deformation->steps;
  return files.empty() ? run_.result.input.path : files[step];
}

SmoothingResult Deformer::follow() {
  run_.document.points = file_points_;
  run_.mesh.points = file_places_;
  move_boundary();
  const Stopwatch watch;
  move_inside();
  // What carries the mesh along is part of the smoothing.
  SmoothingTimings& timings = followed_.smoothing.timings;
  timings.smooth = watch.milliseconds() - timings.prepare - timings.transfer_in - timings.untangle -
                   timings.transfer_out - timings.commit;
  ++done_;
  run_.enter_frame();
  run_.result.coordinates_hash = run_.result.unguarded_hash = coordinates_hash(run_.document.points);
  const MeshView before{file_local_.points, run_.mesh.elements, run_.found.reversed, file_local_.frame.exponent};
  run_.result.size_change = size_change(before, run_.view(), run_.options.smoothing.threads);
  return followed_.smoothing;
}

void Deformer::store(std::size_t vertex, Point2<double> place) {
  const FilePoint file(file_points_.data() + 3 * vertex);
  const Eigen::Vector3d moved = run_.mesh.moved(file, file_places_[vertex], place);
  double* const stored = run_.document.points.data() + 3 * vertex;
  for (int axis = 0; axis < 3; ++axis) {
    stored[axis] = stored_coordinate(run_.document, file[axis], moved[axis]);
  }
  run_.mesh.points[vertex] = run_.mesh.place(vertex, FilePoint(stored));
}

void Deformer::move_boundary() {
  Displacements displacements = find_displacements(run_.document, run_.mesh, *run_.options.deformation, done_, obeys_,
                                                   run_.options.smoothing.threads);
  const std::filesystem::path& file = file_of_step(done_);
  for (const std::string& note : displacements.notes) {
    if (std::ranges::find(said_, note) == said_.end()) {
      run_.note(file.string() + ": " + note);
      said_.push_back(note);
    }
  }
  is_told_ = std::move(displacements.is_given);
  // As far as points may be from the plane that is found for them.
  constexpr double flatness = 1e-6;
  const double most_across = flatness * std::ldexp(1.0, file_local_.frame.exponent);
  const Eigen::Vector3d normal = run_.mesh.plane.normal();
  for (std::size_t v = 0; v < is_told_.size(); ++v) {
    if (obeys_[v] == Obeys::never) {
      is_told_[v] = 0;
    }
    if (is_told_[v] == 0) {
      continue;
    }
    const FilePoint displacement(displacements.of_vertex[v].data());
    const double across = std::abs(displacement.dot(normal));
    if (!(across <= most_across)) {
      throw ReadError(
          file, fmt::format("the displacement of vertex {} leads {:.3g} out of the plane of the mesh, in which it "
                            "is to stay",
                            v, across));
    }
    store(v, run_.mesh.plane.project(FilePoint(file_points_.data() + 3 * v) + displacement));
  }
}

void Deformer::move_inside() {
  const bool is_plain = run_.mesh.plane.aligned && !is_stored_otherwise(run_);
  const MovingStart start = run_.options.deformation->start;
  BulkVector<Point2<double>> places = run_.mesh.points;
  try {
    followed_ = moving_.follow(places, start, is_plain ? storage_of(run_.document) : Storage::float64);
  } catch (const MeshError& error) {
    throw ReadError(run_.options.input, error.what());
  }
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (run_.found.fixed[v] == 0) {
      store(v, places[v]);
    }
  }
  const StoredImage image = stored_image(run_);
  for (const MiddleNode& middle : run_.mesh.middles) {
    if (is_told_[middle.vertex] == 0) {
      follow_corners(middle, image, file_points_, run_.document.points);
      run_.mesh.points[middle.vertex] =
          run_.mesh.place(middle.vertex, FilePoint(run_.document.points.data() + 3 * std::size_t(middle.vertex)));
    }
  }
}

void Deformer::step_checked() {
  PipelineResult& result = run_.result;
  DeformedStep step;
  step.displacements = file_of_step(done_ - 1);
  step.output = output();
  step.quality = *result.after;
  step.quadratic = result.quadratic_after;
  step.min_relative_shape = followed_.min_relative_shape;
  step.mean_relative_shape = followed_.mean_relative_shape;
  step.invalid_held = followed_.invalid_held;
  step.crossings = std::ssize(followed_.crossings);
  step.overlaps = std::ssize(followed_.overlaps);
  for (std::size_t v = 0; v < file_places_.size(); ++v) {
    const Point2<double> way = run_.mesh.points[v] - file_places_[v];
    step.largest_displacement = std::max(step.largest_displacement, std::hypot(way.x, way.y));
  }
  folded_quads_ = std::max(folded_quads_, std::ranges::count_if(valid_quads_, [this](const MixedElement& corners) {
                             return !(shape_quotient(points_of(corners, run_.local.points)) > 0);
                           }));
  step.sweeps = result.smoothing->sweeps;
  step.stop_reason = result.smoothing->stop_reason;
  step.coordinates_hash = result.coordinates_hash;
  steps_.steps.push_back(std::move(step));
  if (done_ == 1 || steps_.steps.back().is_worse_than(steps_.steps[steps_.worst])) {
    steps_.worst = done_ - 1;
    worst_ = result;
  }
  if (!is_done()) {
    return;
  }
  result.after = std::move(worst_.after);
  result.smoothing = std::move(worst_.smoothing);
  result.quadratic_after = worst_.quadratic_after;
  result.regions_after = std::move(worst_.regions_after);
  result.size_change = worst_.size_change;
  result.coordinates_hash = worst_.coordinates_hash;
  result.unguarded_hash = worst_.unguarded_hash;
  run_.note(carried_layers_text(result.smoothing->layers));
  if (const auto ended = std::ranges::count(steps_.steps, StopReason::sweep_limit, &DeformedStep::stop_reason);
      ended > 0) {
    run_.note(
        fmt::format("the sweeps of {} ended at --max-sweeps, where the mesh was still on its way; a larger number "
                    "lets it arrive",
                    counted(ended, "step", "steps")));
  }
  if (folded_quads_ > 0) {
    run_.warn(counted(folded_quads_, "quadrilateral that is held is folded, or has",
                      "quadrilaterals that are held are folded, or have") +
              " a flat corner, where most are: they go where their corners are told, and are in no figure "
              "and no gate; without --quads hold they follow the boundary");
  }
  result.deformation = std::move(steps_);
  for (std::string& warning : warnings_of_deformation(run_.result)) {
    run_.warn(std::move(warning));
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/smooth_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/input/near_corners.h"
#include "trismooth/pipeline/stages/field_stage.h"
#include "trismooth/pipeline/stages/growth_note.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/pipeline/stages/stored_result.h"
#include "trismooth/pipeline/stages/warnings.h"
#include "trismooth/pipeline/stages/write_stage.h"
#include "trismooth/quality/region_area.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/result_text.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"
#include "trismooth/space/plane_smoothing.h"

namespace trismooth {

namespace {

/// `read`, `before_merging`: the points that were read, where they are needed.
void hash_coordinates(RunState& run, std::span<const double> read, std::span<const double> before_merging,
                      const SmoothingResult& smoothing) {
  run.result.coordinates_hash = run.result.unguarded_hash = coordinates_hash(run.document.points);
  if (smoothing.reverted.empty()) {
    return;
  }
  const StoredImage image = stored_image(run);
  std::vector<double> unguarded = run.document.points;
  for (const auto& [vertex, position] : smoothing.reverted) {
    const auto v = static_cast<std::size_t>(vertex);
    double* const point = unguarded.data() + 3 * v;
    std::array<double, 3> moved{};
    image.move(point, run.mesh.points[v], position, moved.data());
    std::transform(moved.begin(), moved.end(), point, point,
                   [&run](double now, double before) { return stored_coordinate(run.document, before, now); });
  }
  for (const MiddleNode& middle : run.mesh.middles) {
    follow_corners(middle, image, read, unguarded);
  }
  follow_merged(run.mesh, before_merging, unguarded);
  run.result.unguarded_hash = coordinates_hash(unguarded);
}

void compare_sizes(RunState& run, const MeshView& before) {
  const Stopwatch watch;
  PipelineResult& result = run.result;
  const int threads = run.options.smoothing.threads;
  result.size_change = size_change(before, run.view(), threads);
  if (run.smoothing.aims_at_sizes()) {
    const std::vector<double> asked = inverse_sizes(run.smoothing, run.found.fixed);
    // Corners that slide change sizes, too.
    const std::vector<std::uint8_t> held =
        run.found.slidable.any() ? run.found.slidable.truly_fixed(run.found.fixed) : run.found.fixed;
    result.size_fit_before = size_fit(before, asked, held, threads);
    result.size_fit_after = size_fit(run.view(), asked, held, threads);
  }
  result.timings_ms.check_after += watch.milliseconds();
}

SmoothingResult smooth_points(RunState& run) {
  PlanarMesh& mesh = run.mesh;
  std::vector<double>& xyz = run.document.points;
  const Storage storage = storage_of(run.document);
  if (!mesh.map && !is_stored_otherwise(run)) {
    return smooth_in_plane(run.found, mesh.elements, mesh.plane, xyz, mesh.points, run.local, storage, run.smoothing);
  }
  const bool is_plain = !mesh.map && mesh.plane.aligned;
  return smooth_in_image(run.found, mesh.elements, mesh.quadratics, mesh.middles, stored_image(run), xyz, mesh.points,
                         run.local, is_plain ? storage : Storage::float64, run.smoothing);
}

}  // namespace

SmoothingResult smooth_mesh(RunState& run) {
  if (run.options.annotate) {
    run.input_points = run.document.points;
    run.metrics_before = metrics_of_cells(run, "_before");
  }
  const std::vector<double> points_read = run.mesh.middles.empty() ? std::vector<double>{} : run.document.points;
  const std::vector<double> before_merging = run.mesh.merged.empty() ? std::vector<double>{} : run.document.points;
  SmoothingResult smoothing =
      limited(run.smoothing, backend_of(run.smoothing).name(), [&run] { return smooth_points(run); });
  smoothing.backend_note = joined_notes(run.found.note, smoothing.backend_note);
  smoothing.quadrilaterals = run.mesh.count_quadrilaterals();
  if (smoothing.stop_reason == StopReason::cancelled) {
    return smoothing;
  }
  follow_merged(run.mesh, before_merging, run.document.points);
  for (std::size_t v = 0; v < run.mesh.merged.size(); ++v) {
    if (!std::equal(before_merging.begin() + 3 * static_cast<std::ptrdiff_t>(v),
                    before_merging.begin() + 3 * static_cast<std::ptrdiff_t>(v + 1),
                    run.document.points.begin() + 3 * static_cast<std::ptrdiff_t>(v))) {
      run.mesh.points[v] = run.mesh.points[static_cast<std::size_t>(run.mesh.merged[v])];
    }
  }
  const LocalPoints input = std::exchange(run.local, {});
  const std::vector<std::uint8_t> input_reversed = run.found.reversed;
  run.enter_frame();
  if (has_shrunk(input.frame, run.local.frame)) {
    warn_of_shrinking(run, input.frame, run.local.frame);
    run.local = entered(input.frame, run.mesh.points);
  }
  if (smoothing.untangling) {
    for (std::size_t t = 0; t < smoothing.untangling->turned.size(); ++t) {
      run.found.reversed[t] ^= smoothing.untangling->turned[t];
    }
  }
  warn_of_folds_put_back(run, smoothing);
  move_fields(run, input);
  hash_coordinates(run, points_read, before_merging, smoothing);
  const MeshView before{input.points, run.mesh.elements, input_reversed, input.frame.exponent};
  compare_sizes(run, before);
  warn_of_sizes_out_of_reach(run, smoothing);
  note_growth_bound(run, before);
  if (smoothing.sliding) {
    compare_areas(run, before);
    run.note(touching_lines_text(*smoothing.sliding, !run.options.slide.coincident, true));
  }
  return smoothing;
}

void compare_areas(RunState& run, const MeshView& before) {
  const Stopwatch watch;
  const std::int32_t count = std::max(run.regions.count(), 1);
  const std::vector<double> areas_before = region_areas(before, run.regions.of_triangle, count);
  const std::vector<double> areas_after = region_areas(run.view(), run.regions.of_triangle, count);
  // (The frame of the result may be another one.)
  for (std::size_t region = 0; region < areas_before.size(); ++region) {
    run.result.areas.push_back({std::ldexp(areas_before[region], 2 * before.exponent),
                                std::ldexp(areas_after[region], 2 * run.local.frame.exponent)});
  }
  run.result.timings_ms.check_after += watch.milliseconds();
}

}  // namespace trismooth

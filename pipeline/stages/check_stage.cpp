#include "trismooth/pipeline/stages/check_stage.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/pipeline/stages/warnings.h"
#include "trismooth/quality/size_ratio.h"

namespace trismooth {

namespace {

QualityReport quality_of(const RunState& run) {
  QualityReport report = quality_report(run.view(), {.threads = run.options.smoothing.threads});
  if (run.options.size_ratio) {
    report.size_ratio = size_ratio_summary(run.view(), run.options.smoothing.threads);
  }
  report.degenerate += run.mesh.repeating_triangles;
  for (WorstElement& element : report.worst) {
    const Triangle& corners = run.mesh.triangles[static_cast<std::size_t>(element.triangle)];
    if (run.regions.count() > 1) {
      element.region = run.regions.of_triangle[static_cast<std::size_t>(element.triangle)];
    }
    element.all_fixed = std::ranges::all_of(corners, [&](std::int32_t v) { return run.found.fixed[v] != 0; });
    element.triangle = run.mesh.cells[static_cast<std::size_t>(element.triangle)];
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

void check_before(RunState& run) {
  run.result.before = quality_of(run);
  run.result.regions_before = quality_of_regions(run);
  run.result.quadratic_before = quality_of_quadratics(run);
}

void check_after(RunState& run) {
  run.result.after = quality_of(run);
  run.result.smoothing->inverted = run.result.after->inverted;
  run.result.smoothing->degenerate = run.result.after->degenerate;
  run.result.regions_after = quality_of_regions(run);
  run.result.quadratic_after = quality_of_quadratics(run);
  for (std::string& warning : warnings_of_invalid(run.result)) {
    run.warn(std::move(warning));
  }
}

}  // namespace trismooth

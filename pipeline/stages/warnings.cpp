// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/warnings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/stages/run_context.h"
#include "trismooth/pipeline/stages/staged_mesh.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/smoothing/result_text.h"

namespace trismooth {

namespace {

void warn_of_precision(StagedMesh& mesh) {
  RunContext& run = mesh.context();
  const SmoothingOptions& options = run.options.smoothing;
  if (options.precision != Precision::single_precision) {
    return;
  }
  if (const PrecisionLoss loss = mesh.precision_loss(); loss.any()) {
    run.warn(describe(loss) + (options.guard ? "; the guard checks the result in double" : "") +
             "; --precision double smooths it as it is");
  }
}

void warn_of_projection(RunContext& run) {
  const QualityReport& before = run.result.before;
  if (run.options.project && before.inverted + before.degenerate > 0) {
    run.warn(
        fmt::format("--project {}: {} of {} {} lie over others or upright there; the mesh is no function of x and y",
                    to_string(*run.options.project), before.inverted + before.degenerate, before.elements(),
                    element_words(before.triangles, before.quadrilaterals).several));
  }
}

/// What is to be done about inverted elements that remain.
std::string_view what_mends(const PipelineResult& result) {
  const std::optional<SmoothingResult>& smoothing = result.smoothing;
  if (smoothing && has_no_time_for_sweeps(*smoothing)) {
    return "there was no time to mend them all: give --time-limit more";
  }
  if (!smoothing || !smoothing->untangling) {
    return "--untangle on mends what can be mended";
  }
  return result.quadratic_after && result.quadratic_after->invalid > 0
             ? "corners go back where the nodes between them would make an element that is not valid: put these nearer "
               "to the middles of their sides, and let held vertices go"
             : "what held vertices fold nothing mends: let some of them go";
}

}  // namespace

std::string warning_of_options_without_effect(const PipelineOptions& options) {
  const MeanRatioOptions& given = options.smoothing.mean_ratio;
  const MeanRatioOptions usual;
  std::vector<std::string_view> names;
  if (options.size_array) {
    names.emplace_back("--size-array");
  }
  if (given.target != usual.target) {
    names.emplace_back("--target");
  }
  if (given.size_weight != usual.size_weight) {
    names.emplace_back("--size-weight");
  }
  if (given.power != usual.power) {
    names.emplace_back("--power");
  }
  std::string warning = options.smoothing.method == Method::mean_ratio || names.empty()
                            ? std::string()
                            : fmt::format("the method {} takes no notice of {}; --method mean-ratio does",
                                          options.smoothing.method_name(), fmt::join(names, ", "));
  const Sliding usual_slide;
  std::vector<std::string_view> of_curves;
  if (options.slide.deviation != usual_slide.deviation) {
    of_curves.emplace_back("--deviation");
  }
  if (options.slide.curve != usual_slide.curve) {
    of_curves.emplace_back("--curve");
  }
  if (options.slide.along == Slide::straight && !of_curves.empty()) {
    warning += fmt::format("{}--slide straight takes no notice of {}; --slide curves does", warning.empty() ? "" : "; ",
                           fmt::join(of_curves, ", "));
  }
  return warning;
}

std::vector<std::string> warnings_of_invalid(const PipelineResult& result) {
  std::vector<std::string> warnings;
  // (Of quadrilaterals whose corners are not in turn a note has told.)
  const std::int64_t crossed = result.input.crossed_quadrilaterals;
  if (result.after && result.after->inverted > crossed) {
    const auto [one, several] = element_words(result.before.triangles, result.before.quadrilaterals);
    const std::int64_t inverted = result.after->inverted - crossed;
    const bool is_one = inverted == 1;
    warnings.push_back(fmt::format("{} inverted {} {} ({} before); {}", inverted, is_one ? one : several,
                                   is_one ? "remains" : "remain", result.before.inverted - crossed,
                                   what_mends(result)));
  }
  if (result.quadratic_after && result.quadratic_after->invalid > 0) {
    const QuadraticQuality& after = *result.quadratic_after;
    warnings.push_back(
        fmt::format("{} of {} {} {} not valid ({} before); they may be with nodes nearer to the middles of their sides",
                    after.invalid, after.elements, quadratic_words(after).second, after.invalid == 1 ? "is" : "are",
                    result.quadratic_before->invalid));
  }
  return warnings;
}

std::string note_of_missed_target(const PipelineOptions& options, const PipelineResult& result) {
  const std::optional<double>& target = options.smoothing.target_quality;
  if (!target || !result.smoothing || !result.after || !((*result.after)[Metric::shape].min < *target)) {
    return {};
  }
  return fmt::format("the smallest shape is {:.4g} and not {:.4g}, which --target-quality asks for: {}",
                     (*result.after)[Metric::shape].min, *target, describe(result.smoothing->stop_reason));
}

std::vector<std::string> warnings_of_deformation(const PipelineResult& result) {
  const DeformationResult& deformation = *result.deformation;
  const DeformedStep& worst = deformation.steps[deformation.worst];
  const std::size_t count = deformation.steps.size();
  const auto where = [count](std::int64_t steps, std::size_t first) {
    return count == 1 ? std::string()
                      : fmt::format(" in {} of {} steps, {} {}", steps, count,
                                    steps == 1 ? "it is step" : "first in step", first + 1);
  };
  const auto in_steps = [&](const auto& has) {
    const auto first = std::ranges::find_if(deformation.steps, has);
    return std::pair(std::ranges::count_if(deformation.steps, has),
                     static_cast<std::size_t>(first - deformation.steps.begin()));
  };
  std::vector<std::string> warnings;
  const auto [invalid, first_invalid] = in_steps([](const DeformedStep& step) { return step.invalid() > 0; });
  if (invalid > 0) {
    std::string text = fmt::format("{} are inverted or degenerate{}: {}{}",
                                   element_words(result.before.triangles, result.before.quadrilaterals).several,
                                   where(invalid, first_invalid), worst.invalid(),
                                   count == 1 ? "" : fmt::format(" in step {}, the worst", deformation.worst + 1));
    if (result.before.inverted + result.before.degenerate > 0) {
      text += fmt::format(" ({} are in the mesh's file)", result.before.inverted + result.before.degenerate);
    }
    if (worst.invalid_held > 0) {
      text +=
          fmt::format(", {} of which have corners of the boundary alone, which itself has folded", worst.invalid_held);
    }
    const bool may_be_layers = result.smoothing->layers.kept > 0 && worst.invalid_held < worst.invalid();
    warnings.push_back(
        text + (may_be_layers
                    ? "; --layers smooth may mend what layers cannot follow, else the boundary needs another mesh"
                    : "; vertices that lack a displacement may be why, else the boundary needs another mesh"));
  }
  if (const auto [crossing, first] = in_steps([](const DeformedStep& step) { return step.crossings > 0; });
      crossing > 0) {
    warnings.push_back(fmt::format(
        "the boundary crosses or touches itself{}: {} of its edges; a mesh with that boundary lies on itself or over "
        "itself, whether elements are inverted or not",
        where(crossing, first), counted(deformation.steps[first].crossings, "pair", "pairs")));
  }
  if (const auto [overlapping, first] = in_steps([](const DeformedStep& step) { return step.overlaps > 0; });
      overlapping > 0) {
    warnings.push_back(fmt::format(
        "the mesh lies over itself{}, at {}: a hole may have been turned inside out, or a slit pushed through itself",
        where(overlapping, first), counted(deformation.steps[first].overlaps, "vertex", "vertices")));
  }
  const std::int64_t quadratic_before = result.quadratic_before ? result.quadratic_before->invalid : 0;
  if (const auto [steps, first] =
          in_steps([&](const DeformedStep& step) { return step.invalid_quadratic() > quadratic_before; });
      steps > 0) {
    const QuadraticQuality& found = *deformation.steps[first].quadratic;
    warnings.push_back(fmt::format("triangles of six nodes are not valid{}: {} of {} ({} before)", where(steps, first),
                                   found.invalid, found.elements, quadratic_before));
  }
  return warnings;
}

void check_deformation(const PipelineOptions& options) {
  if (!options.deformation) {
    return;
  }
  const Deformation& asked = *options.deformation;
  if (!options.output) {
    throw std::invalid_argument("deformation: there is no output for the mesh that follows its boundary");
  }
  if (asked.array.empty() && asked.steps.empty()) {
    throw std::invalid_argument("deformation: neither an array nor a file has the displacements of the boundary");
  }
  if (!asked.is_series && asked.step_count() > 1) {
    throw std::invalid_argument("deformation: several steps are a series");
  }
  if (asked.is_series && is_standard_stream(*options.output)) {
    throw std::invalid_argument("a series of meshes is a series of files, not one on standard output");
  }
  const std::pair<bool, const char*> others[] = {
      {options.slide.along != Slide::off, "vertices that slide"},
      {options.size_array.has_value(), "sizes of an array"},
      {options.geographic, "longitudes and latitudes"},
      {options.project.has_value(), "a projection"},
      {options.merge.has_value(), "merged corners"},
      {options.fields == Fields::interpolate || !options.field_arrays.empty(), "values that follow the mesh"},
      {options.smoothing.time_limit_seconds < std::numeric_limits<double>::infinity(), "a limit of time"}};
  for (const auto& [is_asked, what] : others) {
    if (is_asked) {
      throw std::invalid_argument(
          fmt::format("deformation: a mesh that follows its boundary has no place for {}", what));
    }
  }
}

void warn_of_input(RunContext& run) {
  if (run.options.fixed_ids && run.result.input.fixed_ids_vertices == 0) {
    run.warn(run.options.fixed_ids->string() + ": names no vertices, so it holds none");
  }
}

void warn_before_smoothing(StagedMesh& mesh) {
  RunContext& run = mesh.context();
  warn_of_precision(mesh);
  run.warn(warning_of_options_without_effect(run.options));
  if (const CoarseBoundary coarse = mesh.coarse_boundary(); coarse.any()) {
    run.warn(describe(coarse) + "; put more vertices on the boundary, or hold those behind it (--fixed-ids)");
  }
  run.warn(left_layers_text(run.result.input.layers));
  warn_of_projection(run);
}

std::string note_of_dropped_annotations(std::span<const std::string> names) {
  return fmt::format(
      "annotations of an earlier run, which show another mesh, are left out: {}; --annotate makes new ones",
      fmt::join(names, ", "));
}

void warn_of_folds_put_back(RunContext& run, const SmoothingResult& smoothing) {
  const auto& untangling = smoothing.untangling;
  if (untangling && untangling->inverted_after > untangling->inverted_untangled && smoothing.reverted_vertices > 0) {
    run.warn(
        fmt::format("the never-worse check put vertices back whose moves had inverted valid {0}: {1} {0} are not valid "
                    "now, {2} were after the untangling; --guard off leaves them moved",
                    smoothing.quadrilaterals == 0 ? "triangles" : "elements", untangling->inverted_after,
                    untangling->inverted_untangled));
  }
}

bool has_shrunk(const LocalFrame& input, const LocalFrame& result) {
  return input.exponent > result.exponent;
}

void warn_of_shrinking(RunContext& run, const LocalFrame& input, const LocalFrame& result) {
  constexpr int far = 100;  // powers of two
  const int shrunk = input.exponent - result.exponent;
  if (shrunk > far) {
    run.warn(
        fmt::format("the mesh is 10^{:.0f} times smaller than before, since a vertex came back from far away: elements "
                    "whose numbers vanish beside that distance count as degenerate here and may be inverted; smooth "
                    "the result once more, or put that vertex right in the input",
                    shrunk * std::numbers::ln2 / std::numbers::ln10));
  }
}

void warn_of_sizes_out_of_reach(RunContext& run, const SmoothingResult& smoothing) {
  constexpr double far_off = 1;  // of the logarithm of areas: by a factor of e, in the root of the mean square
  const auto& fit = run.result.size_fit_after;
  if (fit && smoothing.moved_vertices == 0 && run.result.input.free_vertices > 0 && fit->rms_log_ratio > far_off) {
    run.warn(
        fmt::format("no vertex moved: the sizes of '{}' are too far from those of the mesh for any move to bring them "
                    "nearer (rms ln(A/A*) {:.3g}); smoothing shifts triangles, it makes none: ask for sizes nearer "
                    "to those that the mesh has, or let --size-weight be smaller",
                    run.result.input.size_array, fit->rms_log_ratio));
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/text_report.h"

#include <algorithm>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/report/comparison_text.h"
#include "trismooth/pipeline/report/held_text.h"
#include "trismooth/pipeline/report/labelled_line.h"
#include "trismooth/pipeline/report/region_table.h"
#include "trismooth/quality/text/quality_table.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/result_text.h"

namespace trismooth {

namespace {

std::string input_lines(const InputSummary& input, TextDetail detail) {
  std::string what = fmt::format("{}: {}", input.path.string(), counted(input.vertices, "vertex", "vertices"));
  if (input.triangles > 0 || input.quadrilaterals == 0) {
    what += ", " + counted(input.triangles, "triangle", "triangles");
  }
  if (input.quadratic_triangles > 0) {
    what += input.quadratic_triangles == input.triangles
                ? std::string(" of six nodes")
                : fmt::format(", {} of them of six nodes", input.quadratic_triangles);
  }
  if (input.quadrilaterals > 0) {
    what += ", " + counted(input.quadrilaterals, "quadrilateral", "quadrilaterals");
  }
  if (input.quadratic_quadrilaterals > 0) {
    what += input.quadratic_quadrilaterals == input.quadrilaterals
                ? std::string(" of eight or nine nodes")
                : fmt::format(", {} of them of eight or nine nodes", input.quadratic_quadrilaterals);
  }
  if (input.other_cells > 0) {
    what += ", " + (input.has_lines_alone() ? counted(input.lines, "line", "lines")
                                            : counted(input.other_cells, "other cell", "other cells"));
  }
  if (input.components > 1) {
    what += fmt::format(", {} components", input.components);
  }
  std::string text = labelled_line("input:", what);
  if (input.reoriented_triangles > 0 && detail == TextDetail::all) {
    const auto [one, several] = element_words(input.triangles, input.quadrilaterals);
    text +=
        labelled_line("", fmt::format("{} {} listed clockwise against the rest: taken as turned, kept so in the file",
                                      counted(input.reoriented_triangles, one, several),
                                      input.reoriented_triangles == 1 ? "is" : "are"));
  }
  if (!input.region_array.empty() && detail == TextDetail::all) {
    text += labelled_line("regions:", fmt::format("{} by the cell array{} '{}'", input.regions,
                                                  input.region_arrays.size() > 1 ? "s" : "", input.region_array));
  }
  text += labelled_line("fixed:", held_text(input));
  if (input.merged_vertices > 0) {
    text += labelled_line("merged:",
                          counted(input.merged_vertices, "vertex goes with another one", "vertices go with others"));
  }
  if (input.middle_nodes > 0) {
    text += labelled_line("middles:",
                          counted(input.middle_nodes, "vertex moves with its side", "vertices move with their sides"));
  }
  const std::string lines = line_groups_text(input);
  return lines.empty() ? text : text + labelled_line("lines:", lines);
}

std::string device_line(const SmoothingOptions& options, const SmoothingResult& smoothing) {
  return labelled_line("device:", fmt::format("{}, {} execution, {} layout; launches: {}; {} of its memory",
                                              smoothing.device, to_string(options.execution), to_string(options.layout),
                                              launches_text(smoothing), bytes_text(smoothing.device_memory_bytes)));
}

/// The method, who ran it, and what else the user must know of that.
std::string method_lines(const SmoothingOptions& options, const PipelineResult& result, TextDetail detail) {
  const SmoothingResult& smoothing = *result.smoothing;
  const PipelineTimings& timings = result.timings_ms;
  const double smoothing_time =
      timings.transfer_in + timings.untangle + timings.smooth + timings.transfer_out + timings.guard;
  std::string text = labelled_line(
      "smoothing:", fmt::format("{}, form {}, {} precision, {}: {}", options.method_name(), to_string(options.form),
                                to_string(options.precision), who_smoothed(smoothing), duration_text(smoothing_time)));
  if (!smoothing.backend_note.empty()) {
    text += labelled_line("", smoothing.backend_note);
  }
  if (detail == TextDetail::all && ran_on_device(smoothing)) {
    text += device_line(options, smoothing);
  }
  if (!smoothing.reproducible) {
    text += labelled_line("order:", fmt::format("{}: {}", to_string(options.order), not_reproducible_text()));
  }
  return text;
}

std::string result_lines(const PipelineResult& result, TextDetail detail) {
  const SmoothingResult& smoothing = *result.smoothing;
  std::string text = fmt::format("{} moved in {}", counted(smoothing.moved_vertices, "vertex", "vertices"),
                                 counted(smoothing.sweeps, "sweep", "sweeps"));
  if (smoothing.reverted_vertices > 0) {
    text += fmt::format(", {} put back", smoothing.reverted_vertices);
  }
  std::string reason(to_string(smoothing.stop_reason));
  std::ranges::replace(reason, '_', ' ');
  std::string lines = smoothing.untangling && (smoothing.untangling->inverted_before > 0 || detail == TextDetail::all)
                          ? labelled_line("untangling:", untangling_text(smoothing))
                          : std::string{};
  if (smoothing.sliding) {
    lines += labelled_line("sliding:", sliding_text(result));
  }
  lines += labelled_line("result:", text + "; stopped by " + reason);
  if (detail == TextDetail::all) {
    if (smoothing.reverted_vertices > 0) {
      lines += labelled_line("", fmt::format("put back where they had made an element worse, in {}",
                                             counted(smoothing.guard_rounds, "round", "rounds")));
    }
    lines += labelled_line("", describe(smoothing.stop_reason));
  }
  return lines;
}

std::string step_text(const DeformedStep& step) {
  return fmt::format(
      "smallest shape {:.3g}, seen from the input {:.3g}, {:.3g} on average; largest displacement {:.3g}{}{}",
      step.quality[Metric::shape].min, step.min_relative_shape, step.mean_relative_shape, step.largest_displacement,
      (step.invalid() > 0 ? fmt::format("; {} inverted or degenerate", step.invalid()) : "") +
          (step.invalid_quadratic() > 0
               ? fmt::format("; {} with nodes in the middle of their sides not valid", step.invalid_quadratic())
               : ""),
      step.crossings + step.overlaps > 0 ? "; it lies over itself" : "");
}

/// How the mesh followed its boundary; nothing where that stayed.
std::string deformation_lines(const PipelineResult& result, TextDetail detail) {
  if (!result.deformation) {
    return {};
  }
  const std::vector<DeformedStep>& steps = result.deformation->steps;
  const std::size_t worst = result.deformation->worst;
  if (steps.size() == 1) {
    return labelled_line("followed:", step_text(steps.front()));
  }
  std::string text;
  for (std::size_t i = 0; detail == TextDetail::all && i < steps.size(); ++i) {
    text += labelled_line(i == 0 ? "steps:" : "",
                          fmt::format("{}, {}: {}", i + 1, steps[i].displacements.string(), step_text(steps[i])));
  }
  return text + labelled_line("followed:", fmt::format("{} steps; the worst is step {}, {}", steps.size(), worst + 1,
                                                       step_text(steps[worst])));
}

/// Vertices that have moved, be it in the smoothing or from one mesh to the other.
std::int64_t count_moved(const PipelineResult& result) {
  return result.comparison ? result.comparison->moved_vertices : result.smoothing->moved_vertices;
}

/// How the other mesh differs.
std::string comparison_lines(const PipelineResult& result) {
  const ComparisonResult& comparison = *result.comparison;
  std::string text = labelled_line("compared:", comparison.path.string());
  text += labelled_line("moved:", moved_text(result));
  if (comparison.moved_vertices > 0) {
    text +=
        labelled_line("", comparison.held_vertices == 0
                              ? std::string("none of them is held by a smoothing")
                              : fmt::format("{} of them {} held by a smoothing: {}", comparison.held_vertices,
                                            comparison.held_vertices == 1 ? "is" : "are", moved_held_text(comparison)));
    text += labelled_line("elements:", changed_elements_text(comparison));
    text += labelled_line("domain:", areas_text(result));
  }
  return text;
}

/// How sizes changed; nothing where no vertex moved.
std::string sizes_line(const PipelineResult& result) {
  if (!result.size_change || count_moved(result) == 0) {
    return {};
  }
  const SizeChange& change = *result.size_change;
  if (change.triangles == 0) {
    return labelled_line("sizes:", "no element was valid before and is now");
  }
  std::string text = fmt::format("{:.3g} to {:.3g} times the area (98 % of elements), rms ln(A/A0) {:.3g}",
                                 change.ratio_p1, change.ratio_p99, change.rms_log_ratio);
  if (change.left_out > 0) {
    text += fmt::format("; without {} not valid before or after",
                        counted(change.left_out, "element that was", "elements that were"));
  }
  return labelled_line("sizes:", text);
}

/// How far sizes are from those asked for; nothing where none are, or no vertex moved.
std::string size_fit_line(const PipelineResult& result) {
  if (!result.size_fit_before || !result.size_fit_after || result.smoothing->moved_vertices == 0) {
    return {};
  }
  return labelled_line("", fmt::format("off {} '{}' of {}: rms ln(A/A*) {:.3g} before, {:.3g} now",
                                       result.input.sizes_are_areas ? "areas" : "edge lengths", result.input.size_array,
                                       result.input.sizes_are_areas ? "cells" : "points",
                                       result.size_fit_before->rms_log_ratio, result.size_fit_after->rms_log_ratio));
}

/// "a, b and 7 more": what text(item) says of the first few items.
template <class Items, class Text>
std::string few_of(const Items& items, const Text& text) {
  constexpr std::size_t few = 5;
  const std::string list = list_text(std::span(items).first(std::min(few, items.size())), text);
  return items.size() > few ? list + fmt::format(" and {} more", items.size() - few) : list;
}

/// The point arrays that followed the mesh, and those that did not; nothing where there are none.
std::string fields_line(const PipelineResult& result) {
  std::string lines;
  if (!result.fields.empty()) {
    const std::int64_t vertices = result.fields.front().interpolated_vertices;
    const std::string names =
        few_of(result.fields, [](const InterpolatedField& field) { return "'" + field.name + "'"; });
    lines = labelled_line("fields:",
                          names + " interpolated at " + counted(vertices, "vertex that moved", "vertices that moved"));
  }
  if (!result.kept_fields.empty() && result.smoothing->moved_vertices > 0) {
    const std::string names = few_of(result.kept_fields, [](const std::string& name) { return "'" + name + "'"; });
    lines += labelled_line(lines.empty() ? "fields:" : "", names +
                                                               " as read where vertices moved; --fields "
                                                               "interpolate moves the values too");
  }
  return lines;
}

/// (Of those that remain a warning tells.)
std::string inverted_line(const PipelineResult& result) {
  const std::int64_t before = result.before.inverted;
  if (before == 0) {
    return {};
  }
  const auto [one, several] = element_words(result.before.triangles, result.before.quadrilaterals);
  if (!result.after) {
    return fmt::format("{} {} inverted.\n", counted(before, one, several), before == 1 ? "is" : "are");
  }
  return result.after->inverted == 0 ? fmt::format("No inverted {} remain ({} before).\n", several, before) : "";
}

std::string quadratic_lines(const PipelineResult& result) {
  const std::string text = quadratic_text(result);
  return text.empty() ? text : wrapped(text, "", "");
}

}  // namespace

std::string quadratic_text(const PipelineResult& result) {
  if (!result.quadratic_before) {
    return {};
  }
  const QuadraticQuality& before = *result.quadratic_before;
  const QuadraticQuality& now = result.quadratic_after ? *result.quadratic_after : before;
  const auto [one, several] = quadratic_words(now);
  std::string text = fmt::format("Of {} {} not valid", counted(now.elements, one, several),
                                 now.invalid == 0 ? "none is" : counted(now.invalid, "is", "are"));
  if (result.quadratic_after) {
    text += fmt::format(" ({} before)", before.invalid);
  }
  if (now.undecided > 0 || before.undecided > 0) {
    text +=
        fmt::format("; of {} the smallest Jacobian is 0 to rounding, as where middles are at a quarter of their sides",
                    now.undecided);
    if (result.quadratic_after) {
      text += fmt::format(" ({} before)", before.undecided);
    }
  }
  text += fmt::format("; smallest Jacobian {:.3g} of that of straight sides", now.min_jacobian);
  if (result.quadratic_after) {
    text += fmt::format(" ({:.3g} before)", before.min_jacobian);
  }
  return text + ".";
}

std::string untangling_text(const SmoothingResult& smoothing) {
  const UntanglingResult& untangling = *smoothing.untangling;
  const bool are_triangles = smoothing.quadrilaterals == 0;
  std::string text = are_triangles ? "every triangle was valid" : "every element was valid";
  if (untangling.inverted_before > 0) {
    text = fmt::format("{} not valid before, {} after it, {} in the result",
                       counted(untangling.inverted_before, are_triangles ? "triangle" : "element",
                               are_triangles ? "triangles" : "elements"),
                       untangling.inverted_untangled, untangling.inverted_after);
  }
  if (untangling.inverted_fixed > 0) {
    text += fmt::format("; {} more have fixed vertices alone", untangling.inverted_fixed);
  }
  if (untangling.turned_components > 0) {
    text += fmt::format("; {} turned over", counted(untangling.turned_components, "component", "components"));
  }
  return text;
}

std::string sliding_text(const PipelineResult& result) {
  const SlidingResult& sliding = *result.smoothing->sliding;
  return sliding_text(sliding) + (sliding.slid > 0 ? "; " + areas_text(result) : "");
}

std::string_view why_nothing_moved(const PipelineResult& result) {
  if (result.smoothing->moved_vertices > 0 || result.deformation) {
    return {};
  }
  if (result.input.triangles + result.input.quadrilaterals == 0) {
    return "nothing to smooth: the mesh has no triangles";
  }
  if (result.input.free_vertices == 0 && result.smoothing->sliding.value_or(SlidingResult{}).vertices == 0) {
    return "nothing to smooth: every vertex is fixed, for the reasons above; --fixed-array none, --fixed-set none and "
           "--region-array none free those that the file holds, --slide straight lets those on lines slide";
  }
  if (result.smoothing->sweeps == 0 && result.smoothing->stop_reason == StopReason::quality_target) {
    return "nothing moved: the mesh has the target quality already";
  }
  if (result.smoothing->sweeps == 0) {
    return "nothing moved: there was no time for a sweep";
  }
  if (result.smoothing->reverted_vertices > 0) {
    return "nothing moved: every move would have made an element worse and was taken back";
  }
  return "nothing moved: no vertex could be improved";
}

std::string shown_meshes(const PipelineOptions& options, const PipelineResult& result) {
  const std::vector<std::filesystem::path>& others = result.other_outputs;
  const auto text = [](const std::filesystem::path& path) { return path.string(); };
  if (!result.deformation || !options.deformation->is_series) {
    const std::string output = shown_output(*options.written()).string();
    return others.empty() ? output : output + ", " + few_of(others, text);
  }
  const auto ends = [&](const std::filesystem::path& first, const std::filesystem::path& last) {
    return first == last ? text(first) : text(first) + " to " + text(last);
  };
  const std::vector<DeformedStep>& steps = result.deformation->steps;
  const std::string meshes = ends(steps.front().output, steps.back().output);
  return others.empty() ? meshes : meshes + ", " + ends(others.front(), others.back());
}

std::string duration_text(double milliseconds) {
  if (milliseconds < 9.95) {
    return fmt::format("{:.2f} ms", milliseconds);
  }
  return milliseconds < 999.5 ? fmt::format("{:.0f} ms", milliseconds) : fmt::format("{:.1f} s", milliseconds / 1000);
}

bool ran_on_device(const SmoothingResult& smoothing) {
  return smoothing.backend != cpu_backend().name();
}

std::string who_smoothed(const SmoothingResult& smoothing) {
  return smoothing.threads == 0
             ? smoothing.backend
             : fmt::format("{} with {}", smoothing.backend, counted(smoothing.threads, "thread", "threads"));
}

std::string launches_text(const SmoothingResult& smoothing) {
  std::string text = fmt::format("{} by the host", smoothing.kernel_launches);
  if (smoothing.child_launches > 0) {
    text += fmt::format(", {} by the device", smoothing.child_launches);
  }
  return text;
}

std::string_view not_reproducible_text() {
  return "threads saw each other's moves in no fixed order; another run gives another result";
}

std::string text_report(const PipelineOptions& options, const PipelineResult& result, TextDetail detail) {
  std::string text = input_lines(result.input, detail);
  if (detail == TextDetail::all) {
    text += labelled_line("topology:", topology_text(result.topology));
  }
  if (options.geographic) {
    text += labelled_line("map:", "longitude and latitude; shapes and angles are those on the sphere");
  }
  if (result.smoothing) {
    text += method_lines(options.smoothing, result, detail);
    text += result_lines(result, detail);
    text += deformation_lines(result, detail);
    text += sizes_line(result);
    text += size_fit_line(result);
    text += fields_line(result);
  }
  if (result.comparison) {
    text += comparison_lines(result);
    text += sizes_line(result);
  }
  const bool is_summary = result.after && detail == TextDetail::summary && result.before.elements() > 0;
  text +=
      '\n' +
      (is_summary ? format_summary(result.before, *result.after)
                  : format_table(result.before, result.after ? &*result.after : nullptr, short_region_names(result))) +
      '\n';
  if (result.smoothing) {
    if (const std::string_view why = why_nothing_moved(result); !why.empty()) {
      text += fmt::format("{}\n", why);
    }
  }
  text += inverted_line(result);
  text += quadratic_lines(result);
  if (!result.smoothing && result.region_names.size() <= few_regions) {
    text += region_table(result);
  } else if (!result.smoothing) {
    text += fmt::format("{} regions: --verbose shows the worst of them, a report has them all\n",
                        result.region_names.size());
  }
  // What goes to standard output is written behind this text.
  if (const auto& written = options.written(); written && !is_standard_stream(*written)) {
    text += labelled_line("written:", shown_meshes(options, result));
  }
  return text;
}

}  // namespace trismooth

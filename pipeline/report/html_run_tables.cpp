// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/html_run_tables.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "trismooth/base/text/list_text.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/report/comparison_text.h"
#include "trismooth/pipeline/report/held_text.h"
#include "trismooth/pipeline/report/html_page.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/pipeline/report/text_report.h"
#include "trismooth/pipeline/report/timings.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth {

namespace {

using Rows = std::vector<std::pair<std::string, std::string>>;  // name and value, both HTML

std::string row_table(const Rows& rows) {
  std::string html = "<table>\n<tbody>\n";
  for (const auto& [name, value] : rows) {
    html += "<tr>" + html_cell(name) + html_cell(value, "text") + "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string optional_number(double value, std::string_view unit) {
  return value < std::numeric_limits<double>::infinity() ? fmt::format("{}{}", value, unit) : std::string("none");
}

}  // namespace

std::string html_steps_table(const DeformationResult& deformation) {
  static constexpr std::array<const char*, 8> titles{"displacements", "smallest shape",      "seen from the input",
                                                     "on average",    "not valid",           "crossings",
                                                     "overlaps",      "largest displacement"};
  std::string html = "<table class=\"stack wrap\">\n<thead><tr><th>step</th>";
  for (const char* const title : titles) {
    html += fmt::format("<th>{}</th>", title);
  }
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < deformation.steps.size(); ++i) {
    const DeformedStep& step = deformation.steps[i];
    const std::array<std::string, titles.size()> cells{escape_html(step.displacements.string()),
                                                       fmt::format("{:.3g}", step.quality[Metric::shape].min),
                                                       fmt::format("{:.3g}", step.min_relative_shape),
                                                       fmt::format("{:.3g}", step.mean_relative_shape),
                                                       count_text(std::max(step.invalid(), step.invalid_quadratic())),
                                                       count_text(step.crossings),
                                                       count_text(step.overlaps),
                                                       fmt::format("{:.3g}", step.largest_displacement)};
    html += fmt::format("<tr><td>{}{}</td>", i + 1,
                        i == deformation.worst && deformation.steps.size() > 1 ? ", the worst" : "");
    for (std::size_t column = 0; column < cells.size(); ++column) {
      html += html_cell(cells[column], "", titles[column]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string html_gates_table(const std::vector<GateOutcome>& gates) {
  std::string html = "<table>\n<thead><tr><th>demanded</th><th>is</th><th></th></tr></thead>\n<tbody>\n";
  for (const GateOutcome& outcome : gates) {
    html += "<tr>" + html_cell(escape_html(gate_text(outcome.gate)), "text") + html_cell(gate_value_text(outcome)) +
            html_cell(outcome.passed ? "passed" : "failed", outcome.passed ? "word good" : "word bad") + "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string html_options_table(const PipelineOptions& options, const SmoothingResult& smoothing, Topology topology) {
  const SmoothingOptions& chosen = options.smoothing;
  Rows rows{{"method", std::string(chosen.method_name())},
            {"form", std::string(to_string(chosen.form))},
            {"precision", std::string(to_string(chosen.precision))},
            {"guard", chosen.guard ? "on" : "off"},
            {"untangle", std::string(to_string(chosen.untangles() ? Untangle::on : Untangle::off))},
            {"layers", std::string(to_string(chosen.layers))},
            {"sweep limit", chosen.max_sweeps == 0 ? "none" : count_text(chosen.max_sweeps)},
            {"tolerance", fmt::format("{}", chosen.tolerance)},
            {"time limit", optional_number(chosen.time_limit_seconds, " s")},
            {"quality target", chosen.target_quality ? fmt::format("{}", *chosen.target_quality) : "none"}};
  if (options.slide.along != Slide::off) {
    rows.emplace_back("slide", std::string(to_string(options.slide.along)));
    rows.emplace_back("corner angle", fmt::format("{} degrees", options.slide.corner_angle));
    rows.emplace_back("deviation", fmt::format("{}", options.slide.deviation));
    rows.emplace_back("curve", std::string(to_string(options.slide.curve)));
  }
  if (chosen.method == Method::mean_ratio) {
    const MeanRatioOptions& mean_ratio = chosen.mean_ratio;
    rows.emplace_back("size weight", fmt::format("{}", mean_ratio.size_weight));
    rows.emplace_back("power", mean_ratio.power > 0 ? fmt::format("{}", mean_ratio.power) : "by the mean shape");
    rows.emplace_back("target", std::string(to_string(mean_ratio.target)));
    if (options.size_array) {
      rows.emplace_back("sizes by array", escape_html(*options.size_array));
    }
  }
  if (options.geographic) {
    rows.emplace_back("map", "longitude and latitude; shapes and angles are those on the sphere");
  }
  if (options.fixed_array) {
    rows.emplace_back("fixed by array", escape_html(*options.fixed_array));
  }
  for (const std::string& set : options.fixed_sets) {
    rows.emplace_back("fixed by set", escape_html(set));
  }
  if (options.fixed_ids) {
    rows.emplace_back("fixed by file", escape_html(options.fixed_ids->string()));
  }
  rows.emplace_back("backend", escape_html(who_smoothed(smoothing)));
  if (ran_on_device(smoothing)) {
    rows.emplace_back("execution", escape_html(to_string(chosen.execution)));
    rows.emplace_back("layout", escape_html(to_string(chosen.layout)));
    rows.emplace_back("order", escape_html(to_string(chosen.order)));
  }
  if (!smoothing.backend_note.empty()) {
    rows.emplace_back("why this backend", escape_html(smoothing.backend_note));
  }
  rows.emplace_back("device", escape_html(smoothing.device));
  rows.emplace_back("topology", escape_html(topology_text(topology)));
  return row_table(rows);
}

std::string html_outcome_table(const PipelineResult& result) {
  const SmoothingResult& smoothing = *result.smoothing;
  const std::vector<InterpolatedField>& fields = result.fields;
  Rows rows{{"stopped by", escape_html(to_string(smoothing.stop_reason))},
            {"sweeps", count_text(smoothing.sweeps)},
            {"vertex updates", count_text(smoothing.vertex_updates)},
            {"vertices moved", count_text(smoothing.moved_vertices)},
            {"vertices put back", count_text(smoothing.reverted_vertices)},
            {"guard rounds", count_text(smoothing.guard_rounds)}};
  if (smoothing.untangling) {
    rows.emplace_back("untangling", untangling_text(smoothing));
  }
  if (smoothing.sliding) {
    rows.emplace_back("sliding", sliding_text(result));
  }
  if (!fields.empty()) {
    rows.emplace_back("fields interpolated", escape_html(list_text(fields, &InterpolatedField::name)));
  }
  if (!result.kept_fields.empty()) {
    rows.emplace_back("fields as read", escape_html(list_text(result.kept_fields)));
  }
  if (ran_on_device(smoothing)) {
    rows.emplace_back("kernel launches", launches_text(smoothing));
    rows.emplace_back("device memory", bytes_text(smoothing.device_memory_bytes));
  }
  rows.emplace_back("reproducible", smoothing.reproducible ? "yes" : "no");
  return row_table(rows);
}

std::string html_comparison_table(const PipelineResult& result) {
  const ComparisonResult& comparison = *result.comparison;
  Rows rows{{"vertices moved", escape_html(moved_text(result))}};
  if (comparison.rounded_vertices > 0) {
    rows.emplace_back("vertices that differ by rounding alone", count_text(comparison.rounded_vertices));
  }
  if (comparison.moved_vertices > 0) {
    rows.emplace_back("of these held by a smoothing",
                      comparison.held_vertices == 0 ? "none" : escape_html(moved_held_text(comparison)));
    rows.emplace_back("elements around them", changed_elements_text(comparison));
  }
  for (std::size_t region = 0; region < result.areas.size(); ++region) {
    const RegionArea& area = result.areas[region];
    const std::string name =
        region < result.region_names.size() ? "area of " + escape_html(result.region_names[region]) : "area";
    rows.emplace_back(name, area.before == area.after ? fmt::format("{:.10g}", area.before)
                                                      : fmt::format("{:.10g} → {:.10g}, {:+.2g} %", area.before,
                                                                    area.after, 100 * area.relative_change()));
  }
  rows.emplace_back("coordinates", fmt::format("<code>{}</code> (XXH64)", hash_text(comparison.coordinates_hash)));
  return row_table(rows);
}

std::string html_timings_table(const PipelineTimings& timings) {
  const auto parts = timing_parts(timings);
  double longest = 0;
  for (const auto& [name, milliseconds] : parts) {
    longest = std::max(longest, milliseconds);
  }
  std::string html = "<table>\n<tbody>\n";
  for (const auto& [name, milliseconds] : parts) {
    if (milliseconds > 0) {
      std::string label(name);
      std::ranges::replace(label, '_', ' ');
      html += fmt::format(
          "<tr><td>{}</td><td>{}</td><td class=\"meter\"><span style=\"width: {:.1f}%\"></span></td></tr>\n", label,
          duration_text(milliseconds), 100 * milliseconds / longest);
    }
  }
  return html +
         fmt::format("<tr><td>total</td><td>{}</td><td></td></tr>\n</tbody>\n</table>\n", duration_text(timings.total));
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/html_report.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/picture/mesh_view_html.h"
#include "trismooth/pipeline/report/comparison_text.h"
#include "trismooth/pipeline/report/held_html.h"
#include "trismooth/pipeline/report/held_text.h"
#include "trismooth/pipeline/report/html_page.h"
#include "trismooth/pipeline/report/html_run_tables.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/pipeline/report/region_table.h"
#include "trismooth/pipeline/report/svg_charts.h"
#include "trismooth/pipeline/report/text_report.h"
#include "trismooth/quality/size_ratio.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/smoothing/result_text.h"
#include "trismooth/version.h"

namespace trismooth {

namespace {

const QualityReport* after_of(const PipelineResult& result) {
  return result.after ? &*result.after : nullptr;
}

const QualityReport& final_report(const PipelineResult& result) {
  return result.after ? *result.after : result.before;
}

ElementWords words_of(const QualityReport& report) {
  return element_words(report.triangles, report.quadrilaterals);
}

std::string header(const PipelineOptions& options, const PipelineResult& result, const RunRecord& record) {
  const InputSummary& input = result.input;
  std::string counts = fmt::format("{} vertices", count_text(input.vertices));
  if (input.triangles > 0 || input.quadrilaterals == 0) {
    counts += fmt::format(", {} triangles", count_text(input.triangles));
  }
  if (input.quadrilaterals > 0) {
    counts += fmt::format(", {} quadrilaterals", count_text(input.quadrilaterals));
  }
  if (input.other_cells > 0) {
    counts += fmt::format(", {} {}", count_text(input.other_cells), input.has_lines_alone() ? "lines" : "other cells");
  }
  std::string html = fmt::format("<header>\n<div class=\"kind\">{}</div>\n<h1>{}</h1>\n<div class=\"soft\">{}</div>\n",
                                 options.deformation ? "Mesh deformation report"
                                 : options.compared  ? "Mesh comparison report"
                                 : options.output    ? "Mesh smoothing report"
                                                     : "Mesh quality report",
                                 escape_html(input.path.filename().string()), counts);
  if (options.written()) {
    html += fmt::format("<div class=\"soft\">written to <code>{}</code></div>\n",
                        escape_html(shown_meshes(options, result)));
  }
  if (result.comparison) {
    html += fmt::format("<div class=\"soft\">compared with <code>{}</code></div>\n",
                        escape_html(result.comparison->path.string()));
  }
  if (!record.date.empty()) {
    html += fmt::format("<div class=\"soft\">{}</div>\n", escape_html(record.date));
  }
  return html + "</header>\n";
}

/// The outcome in one sentence or two.
std::string lead(const PipelineResult& result, const RunRecord& record) {
  const QualityReport& last = final_report(result);
  const auto [one, several] = words_of(last);
  std::string text;
  if (last.elements() == 0) {
    text = "The mesh has no triangles.";
  } else if (result.smoothing && result.smoothing->moved_vertices == 0) {
    text = std::string(why_nothing_moved(result)) + ". The mesh is as it was.";
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  } else if (result.smoothing) {
    const SlidingResult sliding = result.smoothing->sliding.value_or(SlidingResult{});
    text = fmt::format("{} of {} free vertices moved", count_text(result.smoothing->moved_vertices - sliding.slid),
                       count_text(result.input.free_vertices));
    if (sliding.vertices > 0) {
      text += fmt::format(", and {} of {} on lines slid,", count_text(sliding.slid), count_text(sliding.vertices));
    }
    text += fmt::format(" in {} sweep{}; {}.", count_text(result.smoothing->sweeps),
                        result.smoothing->sweeps == 1 ? "" : "s", describe(result.smoothing->stop_reason));
  }
  if (const auto& comparison = result.comparison; comparison && last.elements() > 0) {
    text = fmt::format(
        "{} of {} vertices moved{}.", count_text(comparison->moved_vertices), count_text(result.input.vertices),
        comparison->held_vertices > 0
            ? fmt::format(", {} of them where a smoothing holds them", count_text(comparison->held_vertices))
            : "");
  }
  if (last.inverted > 0) {
    text += fmt::format(" {} of {} {} {} inverted.", count_text(last.inverted), count_text(last.elements()), several,
                        result.smoothing ? "are still" : "are");
  } else if (last.elements() > 0) {
    text += fmt::format(" No {} is inverted.", one);
  }
  if (const std::string quadratic = quadratic_text(result); !quadratic.empty()) {
    text += " " + quadratic;
  }
  if (last.degenerate > 0) {
    text += fmt::format(" {} without area.", last.degenerate == 1
                                                 ? fmt::format("1 {} is", one)
                                                 : fmt::format("{} {} are", count_text(last.degenerate), several));
  }
  const auto failed = std::ranges::count(record.gates, false, &GateOutcome::passed);
  if (failed > 0) {
    text += fmt::format(" {} of {} gate{} failed.", failed, record.gates.size(), record.gates.size() == 1 ? "" : "s");
  }
  if (result.smoothing && !result.smoothing->reproducible) {
    text += fmt::format(" Not reproducible: {}.", escape_html(not_reproducible_text()));
  }
  const auto& quadratic = result.quadratic_after ? result.quadratic_after : result.quadratic_before;
  const bool bad = last.inverted > 0 || last.degenerate > 0 || failed > 0 || (quadratic && quadratic->invalid > 0);
  return fmt::format("<p class=\"lead{}\">{}</p>\n", bad ? " bad" : "", text);
}

std::string card(std::string_view label, const std::string& value, const std::string& detail) {
  return fmt::format(
      "<div class=\"card\"><div class=\"label\">{}</div><div class=\"value\">{}</div><small>{}</small></div>\n", label,
      value, detail);
}

/// "0.12 → 0.34", or the one value of a run without smoothing.
std::string change(const PipelineResult& result, const std::string& before, const std::string& after) {
  return result.after ? fmt::format("<span class=\"from\">{} →</span> {}", before, after) : before;
}

std::string metric_card(const PipelineResult& result, std::string_view label, Metric metric,
                        double MetricSummary::*value, std::string_view unit, const std::string& detail) {
  const double before = result.before[metric].*value;
  const double after = final_report(result)[metric].*value;
  TextPair texts = distinct_texts(before, after, decimals(metric));
  texts.before += unit;
  texts.after += unit;
  return card(label, change(result, texts.before, texts.after), detail);
}

std::string size_card(const SizeChange& change, std::string_view elements) {
  const std::string left_out =
      change.left_out > 0 ? fmt::format("; {} not valid before or after left out", count_text(change.left_out)) : "";
  return card("Areas, after by before", fmt::format("{:.3g} to {:.3g}", change.ratio_p1, change.ratio_p99),
              fmt::format("98 % of the {}; root mean square of the logarithm {:.3g}{}", elements, change.rms_log_ratio,
                          left_out));
}

std::string cards(const PipelineResult& result) {
  const QualityReport& last = final_report(result);
  const std::string elements(words_of(last).several);
  std::string html = metric_card(result, "Smallest shape", Metric::shape, &MetricSummary::min, "",
                                 last.quadrilaterals == 0 ? "1 is equilateral, 0 degenerate"
                                 : last.triangles == 0    ? "1 is a square, 0 degenerate"
                                                          : "1 is equilateral, or a square; 0 degenerate");
  html +=
      metric_card(result, "Mean shape", Metric::shape, &MetricSummary::mean, "",
                  percent_text(last[Metric::shape].acceptable_fraction) + " % of the " + elements + " are acceptable");
  html += metric_card(result, "Smallest angle", Metric::min_angle, &MetricSummary::min, "°",
                      "largest angle " + number_text(last[Metric::max_angle].max, decimals(Metric::max_angle)) + "°");
  const std::string inverted =
      fmt::format("<span class=\"{}\">{}</span>", last.inverted > 0 ? "bad" : "good", count_text(last.inverted));
  html += card(
      "Inverted " + elements,
      result.after ? fmt::format("<span class=\"from\">{} →</span> {}", count_text(result.before.inverted), inverted)
                   : inverted,
      fmt::format("of {}; {} degenerate", count_text(last.elements()),
                  result.after && result.before.degenerate != last.degenerate
                      ? fmt::format("{} → {}", count_text(result.before.degenerate), count_text(last.degenerate))
                      : count_text(last.degenerate)));
  const InputSummary& input = result.input;
  html += card("Free vertices", count_text(input.free_vertices),
               fmt::format("{} fixed{}", count_text(input.fixed_vertices),
                           input.region_array.empty()
                               ? std::string{}
                               : fmt::format("; {} by array {}",
                                             input.regions == 1 ? "1 region" : count_text(input.regions) + " regions",
                                             escape_html(input.region_array))));
  if (result.size_change && result.size_change->triangles > 0) {
    html += size_card(*result.size_change, elements);
  }
  if (result.size_fit_before && result.size_fit_after) {
    html += card("Sizes off those asked for",
                 change(result, fmt::format("{:.3g}", result.size_fit_before->rms_log_ratio),
                        fmt::format("{:.3g}", result.size_fit_after->rms_log_ratio)),
                 "by array " + escape_html(input.size_array) +
                     "; root mean square of the logarithm of the area by that asked for");
  }
  html += card("Time", duration_text(result.timings_ms.total),
               result.smoothing ? duration_text(result.timings_ms.smooth) + " in sweeps" : "in all");
  return "<div class=\"cards\">\n" + html + "</div>\n";
}

/// `report`: whose metric it is. What it means is said of one kind of elements.
std::string metric_name_cell(const MetricInfo& metric, const QualityReport& report) {
  const std::string unit = metric.unit.empty() ? std::string{} : fmt::format(", {}", escape_html(metric.unit));
  const std::string meaning =
      report.kinds.size() > 1 ? "each kind by its own definition" : escape_html(metric.meaning) + unit;
  return html_cell(fmt::format("{}<small>{}</small>", metric.name, meaning));
}

std::string metric_table(const QualityReport& report) {
  std::string html =
      "<table class=\"stack\">\n<thead><tr><th>metric</th><th>min</th><th>mean</th><th>max</th><th>std. deviation</th>"
      "<th>acceptable %</th></tr></thead>\n<tbody>\n";
  for (const MetricInfo* const shown : metrics_of(report)) {
    const MetricInfo& metric = *shown;
    const MetricSummary& summary = summary_of(report, metric);
    const int digits = decimals(metric.metric);
    html += "<tr>" + metric_name_cell(metric, report) +
            html_cell(number_text(summary.min, digits), metric.larger_is_better ? "strong" : "", "min") +
            html_cell(number_text(summary.mean, digits), "", "mean") +
            html_cell(number_text(summary.max, digits), metric.larger_is_better ? "" : "strong", "max") +
            html_cell(number_text(summary.stddev, digits), "", "std. deviation") +
            html_cell(percent_text(summary.acceptable_fraction), "", "acceptable %") + "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string_view verdict_class(std::string_view verdict) {
  if (verdict == "better") {
    return "word good";
  }
  return verdict == "worse" ? "word bad" : verdict == "mixed" ? "word mixed" : "word soft";
}

std::string metric_table(const QualityReport& before, const QualityReport& after) {
  std::string html =
      "<table class=\"stack\">\n<thead><tr><th></th><th class=\"group start\" colspan=\"2\">min</th>"
      "<th class=\"group start\" colspan=\"2\">mean</th><th class=\"group start\" colspan=\"2\">max</th>"
      "<th class=\"group start\" colspan=\"2\">acceptable %</th><th></th></tr>\n<tr><th>metric</th>";
  for (int group = 0; group < 4; ++group) {
    html += "<th class=\"start\">before</th><th>after</th>";
  }
  html += "<th></th></tr></thead>\n<tbody>\n";
  for (const MetricInfo* const shown : metrics_of(after)) {
    const MetricInfo& metric = *shown;
    const MetricSummary& from = summary_of(before, metric);
    const MetricSummary& to = summary_of(after, metric);
    const int digits = decimals(metric.metric);
    // The bad end of the range is what decides: it stands out, in enough digits to see a change.
    const auto end_of_range = [&](std::string_view label, double MetricSummary::*value, bool is_bad_end) {
      const TextPair texts = is_bad_end ? distinct_texts(from.*value, to.*value, digits)
                                        : TextPair{number_text(from.*value, digits), number_text(to.*value, digits)};
      return html_cell(texts.before, "start", label) + html_cell(texts.after, is_bad_end ? "strong" : "");
    };
    const std::string_view judged = verdict(metric.metric, from, to);
    html += "<tr>" + metric_name_cell(metric, after) +
            end_of_range("min", &MetricSummary::min, metric.larger_is_better) +
            end_of_range("mean", &MetricSummary::mean, false) +
            end_of_range("max", &MetricSummary::max, !metric.larger_is_better) +
            html_cell(percent_text(from.acceptable_fraction), "start", "acceptable %") +
            html_cell(percent_text(to.acceptable_fraction)) + html_cell(judged, verdict_class(judged)) + "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string histogram(const PipelineResult& result) {
  std::string html = "<figure>\n";
  if (result.after) {
    html +=
        "<div class=\"legend\"><span><i class=\"before\"></i>before</span><span><i class=\"after\"></i>after</span>"
        "</div>\n";
  }
  return html + shape_histogram_svg(result.before, after_of(result)) + "</figure>\n";
}

/// The number of an element, that leads to it in the view of the mesh.
std::string element_link(std::int64_t element, std::string_view state) {
  return state.empty()
             ? std::to_string(element)
             : fmt::format(R"(<button type="button" data-element="{0}" data-state="{1}">{0}</button>)", element, state);
}

/// Of a mesh of one region, or none, `names` is empty.
/// `state`: "before" or "after", where the page shows the mesh, else empty.
std::string worst_table(std::string_view title, const QualityReport& report, const std::vector<std::string>& names,
                        std::string_view state) {
  std::string html = fmt::format(
      "<div>\n{}<table>\n<thead><tr><th>element</th><th>shape</th><th>centroid</th>{}</tr>"
      "</thead>\n<tbody>\n",
      title.empty() ? std::string{} : fmt::format("<h3>{}</h3>\n", title), names.empty() ? "" : "<th>region</th>");
  for (const WorstElement& element : report.worst) {
    html += "<tr>" + html_cell(element_link(element.element, state)) +
            html_cell(number_text(element.shape, decimals(Metric::shape)), element.shape < 0 ? "bad" : "") +
            html_cell(fmt::format("{:.7g}, {:.7g}{}", element.centroid.x, element.centroid.y,
                                  element.all_fixed ? "<small>all corners fixed</small>" : ""),
                      "text") +
            (names.empty() ? "" : html_cell(element.region < 0 ? "" : escape_html(names[element.region]), "text")) +
            "</tr>\n";
  }
  return html + "</tbody>\n</table>\n</div>\n";
}

std::string worst_tables(const PipelineResult& result) {
  const std::vector<std::string> names =
      result.region_names.size() < 2 ? std::vector<std::string>{} : result.region_names;
  const bool has_view = result.picture != nullptr;
  const std::string tables = result.after ? worst_table("before", result.before, names, has_view ? "before" : "") +
                                                worst_table("after", *result.after, names, has_view ? "after" : "")
                                          : worst_table("", result.before, names, has_view ? "before" : "");
  return "<div class=\"two\">\n" + tables + "</div>\n";
}

std::string footer(const PipelineResult& result, const RunRecord& record) {
  const std::string hash =
      result.smoothing ? fmt::format("; coordinates <code>{}</code> (XXH64)", hash_text(result.coordinates_hash)) : "";
  const std::string command =
      record.command.empty() ? std::string{} : fmt::format("<div><code>{}</code></div>\n", escape_html(record.command));
  return fmt::format("<footer>\n{}trismooth {}; input <code>{}</code>{}; peak memory {}</footer>\n", command, version(),
                     escape_html(result.input.path.string()), hash, bytes_text(result.peak_memory_bytes));
}

std::string body(const PipelineOptions& options, const PipelineResult& result, const RunRecord& record) {
  std::string html = header(options, result, record) + lead(result, record);
  const QualityReport* const after = after_of(result);
  if (result.before.elements() > 0) {
    html += cards(result);
  }
  if (!result.warnings.empty()) {
    html += html_section("Warnings", html_list(result.warnings));
  }
  if (result.picture && result.before.elements() > 0) {
    Workers workers(options.smoothing.threads);
    html += html_section_begin("The mesh");
    add_mesh_view(html, *result.picture, workers);
    html += html_section_end;
  } else if (options.picture && result.before.elements() > 0) {
    html += html_section("The mesh",
                         "<p>Of a mesh in pieces no picture is kept; <code>trismooth compare</code> of the input with "
                         "the output makes a report that shows it.</p>\n");
  }
  if (!record.gates.empty()) {
    html += html_section("Gates", html_gates_table(record.gates));
  }
  if (result.deformation) {
    html += html_section(result.deformation->steps.size() == 1 ? "How it followed its boundary" : "Steps",
                         html_steps_table(*result.deformation));
  }
  if (result.comparison) {
    html += html_section("What moved", html_comparison_table(result));
  }
  if (result.before.elements() > 0) {
    html +=
        html_section("Quality", after == nullptr ? metric_table(result.before) : metric_table(result.before, *after));
    for (std::size_t k = 0; result.before.kinds.size() > 1 && k < result.before.kinds.size(); ++k) {
      const QualityReport of_kind = report_of(result.before.kinds[k]);
      html +=
          html_section("Quality of " + std::string(words_of(of_kind).several),
                       after == nullptr ? metric_table(of_kind) : metric_table(of_kind, report_of(after->kinds[k])));
    }
    html += html_section("Distribution of shape", histogram(result));
  }
  if (!result.regions_before.empty()) {
    html += html_section("Quality by region", region_table_html(result));
  }
  html += html_section("What is held fixed", held_html(result.input));
  if (result.smoothing && !result.smoothing->history.empty()) {
    html += html_section("Convergence", "<figure>\n" + convergence_svg(result.smoothing->history) + "</figure>\n");
  }
  if (!result.before.worst.empty()) {
    html += html_section("Worst elements", worst_tables(result));
  }
  if (!result.losses.empty()) {
    html += html_section("Not kept", html_list(result.losses));
  }
  if (!result.notes.empty()) {
    html += html_section("Notes", html_list(result.notes));
  }
  if (result.smoothing) {
    html += "<div class=\"two\">\n" +
            html_section("Options", html_options_table(options, *result.smoothing, result.topology)) +
            html_section("Smoothing", html_outcome_table(result)) + "</div>\n";
  }
  html += html_section("Time", html_timings_table(result.timings_ms));
  html += footer(result, record);
  return html;
}

}  // namespace

std::string html_report(const PipelineOptions& options, const PipelineResult& result, const RunRecord& record) {
  return html_page(result.input.path.filename().string(), body(options, result, record),
                   result.picture ? mesh_view_style() : std::string_view{});
}

}  // namespace trismooth

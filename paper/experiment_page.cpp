// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "trismooth/paper/experiment_report.h"
#include "trismooth/paper/figures.h"
#include "trismooth/paper/log_chart.h"
#include "trismooth/paper/wording.h"
#include "trismooth/pipeline/report/html_page.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/version.h"

namespace trismooth::experiments {

namespace {

constexpr std::string_view bench_style = R"css(
.claims { counter-reset: claim; }
.claim { border-top: 1px solid var(--line); padding: 14px 0 10px; break-inside: avoid; }
.claim .head { display: flex; justify-content: space-between; gap: 24px; align-items: baseline; margin-bottom: 6px; }
.claim .text { font-weight: 650; }
.claim .verdict { font-weight: 650; white-space: nowrap; }
.claim ul { color: var(--soft); }
details { margin-top: 8px; }
summary { color: var(--soft); font-size: 13px; cursor: pointer; }
table.wide th, table.wide td { padding: 4px 8px; }
table.wide th { white-space: normal; }
th.word, td.than { text-align: left; }
table caption { text-align: left; font-weight: 650; padding: 18px 0 4px; }
table.wide td small { font-size: 11px; white-space: nowrap; }
td.paper, th.paper { background: #f5f7f9; }
figure { margin: 0 0 20px; }
figcaption { color: var(--soft); font-size: 13px; margin-top: 4px; }
.narrow-window { display: none; max-width: 520px; }
@media screen and (max-width: 960px) {
  .wide-window { display: none; }
  .narrow-window { display: block; }
  .claim .head { flex-wrap: wrap; gap: 0 24px; }
  .claim table.stack td:first-child { grid-column: 1 / -1; }
  table.stack caption { display: block; }
  table.stack td.start + td[data-label]::before { content: attr(data-label); }
  table.stack td[data-label] { flex-wrap: wrap; justify-content: flex-end; column-gap: 8px; }
  table.stack td[data-label]::before { margin-right: auto; font-weight: 400; }
  table.wide td.start[data-label] { grid-column: 1 / -1; }
  table.wide td { padding: 0; }
  table.wide td small { font-size: 12px; line-height: inherit; }
  /* This machine and the paper side by side, under the size. */
  table.twice tbody { grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr)); }
  table.twice tr { grid-auto-flow: dense; grid-template-columns: minmax(0, 1fr) 5em; column-gap: 8px; }
  table.twice td:is([data-label], .start[data-label]) { grid-column: 1; }
  table.twice td:first-child { grid-column: 1 / -1; display: flex; justify-content: space-between; }
  table.twice td:first-child::after { content: "the paper"; color: var(--soft); font-weight: 400; }
  table.twice td.paper { grid-column: 2; padding: 0 4px; }
  table.twice td.paper::before { content: none !important; }
}
@page { size: A4 landscape; }
@media print { table.wide, table.wide th { font-size: 8.5pt; } table.wide td, table.wide th { padding: 2px 6px; }
               .figures { break-before: page; } svg { max-height: 165mm; } }
)css";

/// A spread as a number with its bounds in small print.
std::string spread_html(const Spread& spread) {
  const std::string text = spread.text();
  const std::size_t bounds = text.find(' ');
  return text.substr(0, bounds) + " <small>" + text.substr(bounds + 1) + "</small>";
}

std::string spread_cell(const std::optional<Spread>& spread, std::string_view label, std::string_view classes = "") {
  return html_cell(spread ? spread_html(*spread) : "-", classes, label);
}

std::string_view class_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "good";
    case Verdict::does_not:
      return "bad";
    case Verdict::in_part:
      return "mixed";
    default:
      return "soft";
  }
}

std::string header(const ExperimentReport& report) {
  const Setting& setting = report.setting;
  const std::string where = setting.gpu.empty() ? setting.cpu : setting.gpu;
  std::string cpu = escape_html(setting.cpu);
  if (setting.threads > 0) {
    cpu += fmt::format(", {} thread{}", setting.threads, setting.threads == 1 ? "" : "s");
  }
  return fmt::format(
      "<header>\n<div class=\"kind\">Smart Laplacian smoothing: the paper's experiments</div>\n<h1>{}</h1>\n"
      "<div class=\"soft\">CPU: {}. GPU: {}. Smoothing in {} precision, up to {} of each. {}.</div>\n</header>\n",
      escape_html(where), cpu, setting.gpu.empty() ? "none used" : escape_html(setting.gpu),
      to_string(report.result.options.precision), runs_text(report.result.options.runs), escape_html(setting.date));
}

std::string comparison_table(const std::vector<Comparison>& comparisons) {
  std::string html =
      "<table class=\"stack\">\n<thead><tr><th>claimed to be faster</th><th "
      "class=\"word\">than</th><th>size</th><th>times as fast</th>"
      "<th>in the paper</th><th>sweeps</th><th>supports the claim</th></tr></thead>\n<tbody>\n";
  for (const Comparison& comparison : comparisons) {
    html += "<tr>" + html_cell(full_name(comparison.claimed_faster)) +
            html_cell(full_name(comparison.claimed_slower), "than", "than") +
            html_cell(size_text(comparison.vertices), "", "size") +
            html_cell(spread_html(comparison.factor), "", "times as fast") +
            html_cell(comparison.published ? three_digits(*comparison.published) : "-", "", "in the paper") +
            html_cell(comparison.sweeps ? fmt::format("{:.0f} / {:.0f}", (*comparison.sweeps)[0].median,
                                                      (*comparison.sweeps)[1].median)
                                        : "-",
                      "", "sweeps") +
            html_cell(to_string(comparison.support), "", "supports the claim") + "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string claim_html(const Conclusion& conclusion) {
  std::string html = fmt::format(
      "<div class=\"claim\"><div class=\"head\"><span class=\"text\">{}. {}</span><span class=\"verdict {}\">{}</span>"
      "</div>\n",
      conclusion.number, escape_html(conclusion.claim), class_of(conclusion.verdict), to_string(conclusion.verdict));
  html += html_list(conclusion.findings);
  if (!conclusion.comparisons.empty()) {
    html += fmt::format("<details><summary>The {} comparisons behind this</summary>\n{}</details>\n",
                        conclusion.comparisons.size(), comparison_table(conclusion.comparisons));
  }
  return html + "</div>\n";
}

std::string claims(const std::vector<Conclusion>& conclusions) {
  std::string html = "<div class=\"claims\">\n";
  for (const Conclusion& conclusion : conclusions) {
    html += claim_html(conclusion);
  }
  return html + "</div>\n";
}

/// The columns of the paper's layout.
constexpr std::array<std::string_view, 5> columns_of_paper{"serial CPU ms", "AoS ms", "SoA ms", "AoS speedup",
                                                           "SoA speedup"};

/// The head of a table in the paper's layout; the columns of the paper's own figures are marked.
std::string table_head(bool with_paper) {
  const auto columns = [](std::string_view classes) {
    std::string html;
    for (const std::string_view name : columns_of_paper) {
      html += fmt::format("<th class=\"{}{}\">{}</th>", html.empty() ? "start " : "", classes, name);
    }
    return html;
  };
  std::string html = "<thead>";
  if (with_paper) {
    html +=
        "<tr><th></th><th class=\"group start\" colspan=\"5\">this machine</th>"
        "<th class=\"group start paper\" colspan=\"5\">the paper</th></tr>\n";
  }
  return html + "<tr><th>size</th>" + columns("") + (with_paper ? columns("paper") : "") + "</tr></thead>\n";
}

std::string paper_cells(const PublishedRow* row) {
  std::string html;
  if (row == nullptr) {
    for (int column = 0; column < 5; ++column) {
      html += html_cell("-", "paper");
    }
    return html;
  }
  return html_cell(fmt::format("{}", row->cpu_ms), "start paper") +
         html_cell(fmt::format("{:.1f}", row->aos_ms), "paper") +
         html_cell(fmt::format("{:.1f}", row->soa_ms), "paper") +
         html_cell(fmt::format("{:.2f}", row->aos_speedup), "paper") +
         html_cell(fmt::format("{:.2f}", row->soa_speedup), "paper");
}

std::string table_html(const Table& table) {
  const bool with_paper = table.number > 0;
  std::string html = fmt::format("<table class=\"wide stack{}\"><caption>{}</caption>\n{}<tbody>\n",
                                 with_paper ? " twice" : "", escape_html(table.title), table_head(with_paper));
  for (const TableRow& row : table.rows) {
    const auto& names = columns_of_paper;
    html += "<tr>" + html_cell(size_text(row.vertices)) + spread_cell(row.serial_ms, names[0], "start") +
            spread_cell(row.aos_ms, names[1]) + spread_cell(row.soa_ms, names[2]) +
            spread_cell(row.aos_speedup, names[3], "start") + spread_cell(row.soa_speedup, names[4]) +
            (with_paper ? paper_cells(row.published) : std::string{}) + "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

/// The paper's, all; or the others, as far as something was measured.
std::string tables_html(const ExperimentReport& report, bool of_paper) {
  std::string html;
  for (const Table& table : report.tables) {
    if (of_paper ? table.number > 0 : table.number == 0 && table.missing_reason.empty()) {
      html += table_html(table);
    }
  }
  return html;
}

std::string figure(std::string (*svg)(const ExperimentResult&, Arrangement), const ExperimentResult& result,
                   std::string_view caption) {
  const std::string row = svg(result, Arrangement::row);
  return row.empty() ? std::string{}
                     : fmt::format(
                           "<figure>\n<div class=\"wide-window\">\n{}</div>\n<div class=\"narrow-window\">\n{}</div>\n"
                           "<figcaption>{}</figcaption>\n</figure>\n",
                           row, svg(result, Arrangement::column), caption);
}

std::string figures(const ExperimentResult& result) {
  return figure(&forms_figure, result,
                "Figure 3 of the paper: running time of Forms A and B by layout. Form B of the GPU and CDP versions is "
                "unordered, as in the paper. Bars span all runs; the paper's own times are grey.") +
         figure(&speedup_figure, result,
                "Figure 4 of the paper: speedup of the versions over the serial CPU version. The paper's own are grey; "
                "its serial version ran on another processor.");
}

std::string mesh_table(const ExperimentResult& result, const MeshCounts& mesh) {
  std::string html = fmt::format(
      "<table class=\"wide stack\"><caption>{}: {} vertices, {} triangles</caption>\n<thead>"
      "<tr><th></th><th></th><th class=\"group start\" colspan=\"4\">ms</th><th></th>"
      "<th class=\"group start\" colspan=\"2\">times faster</th></tr>\n<tr><th>version</th><th class=\"word\">form</th>"
      "<th class=\"start\">topology</th><th>transfer</th><th>smoothing</th><th>together</th><th>sweeps</th>"
      "<th class=\"start\">smoothing</th><th>together</th></tr></thead>\n<tbody>\n",
      size_text(mesh.asked), count_text(mesh.vertices), count_text(mesh.triangles));
  for (const Row& row : result.rows) {
    if (row.vertices != mesh.asked || !row.measured) {
      continue;
    }
    const Measurement& measured = *row.measured;
    html += "<tr>" + html_cell(name_of(row.what)) + html_cell(form_of(row.what), "word") +
            spread_cell(measured.topology, "topology, ms", "start") +
            spread_cell(runs_on_device(row.what.version) ? std::optional(measured.transfer) : std::nullopt,
                        "transfer, ms") +
            spread_cell(measured.smoothing, "smoothing, ms", "strong") +
            spread_cell(measured.together, "together, ms") + html_cell(sweeps_text(measured.sweeps), "", "sweeps") +
            spread_cell(result.speedup(row.vertices, row.what), "times faster, smoothing", "start") +
            spread_cell(result.speedup_together(row.vertices, row.what), "times faster, together") + "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string mesh_tables(const ExperimentResult& result) {
  std::string html;
  for (const MeshCounts& mesh : result.meshes) {
    if (any_measured_on(result, mesh)) {
      html += mesh_table(result, mesh);
    }
  }
  return html;
}

std::string footer(const ExperimentReport& report) {
  return fmt::format("<footer>trismooth {}; <code>{}</code></footer>\n", version(),
                     escape_html(report.setting.command));
}

std::string section_of_class(std::string_view name, const std::string& section) {
  return section.empty() ? std::string{} : fmt::format("<div class=\"{}\">\n{}</div>\n", name, section);
}

}  // namespace

std::string page_of(const ExperimentReport& report) {
  const std::string paper = fmt::format(
      "<p class=\"soft\">Milliseconds of smoothing, median (least-most), and speedups over the serial CPU version. In "
      "the paper: running times ({}; {}).</p>\n",
      published_gpu, published_cpu);
  std::string body = header(report);
  body +=
      section_of_class("conclusions", html_section("The paper's claims on this machine", claims(report.conclusions)));
  if (const std::string of_paper = tables_html(report, true); !of_paper.empty()) {
    body += html_section("The paper's tables", paper + of_paper);
  }
  body += section_of_class("figures", html_section("The paper's figures", figures(report.result)));
  if (const std::string beyond = tables_html(report, false); !beyond.empty()) {
    body += html_section("Beyond the paper", beyond);
  }
  body += html_section("All measurements", mesh_tables(report.result));
  body += html_section("Remarks", html_list(remarks_on(report)));
  body += html_section("How it is measured", html_list(how_it_is_measured()));
  return html_page("The paper's experiments", body + footer(report), bench_style);
}

}  // namespace trismooth::experiments

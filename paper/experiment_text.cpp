// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/paper/experiment_report.h"
#include "trismooth/paper/wording.h"
#include "trismooth/pipeline/report/labelled_line.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/quality/text/text_columns.h"
#include "trismooth/version.h"

namespace trismooth::experiments {

namespace {

using Align = TextColumns::Align;

constexpr std::size_t gap = 2;

std::string median_or_dash(const std::optional<Spread>& spread) {
  return spread ? three_digits(spread->median) : "-";
}

std::string heading(const ExperimentReport& report) {
  const ExperimentOptions& options = report.result.options;
  const Setting& setting = report.setting;
  std::string text =
      wrapped(fmt::format("trismooth {}: the experiments of the paper, {} precision, up to {} each, {}", version(),
                          to_string(options.precision), runs_text(options.runs), setting.date),
              "", "  ");
  const std::string threads = setting.threads > 0 ? fmt::format(", {} threads", setting.threads) : std::string{};
  text += labelled_line("CPU:", setting.cpu + threads);
  return text + labelled_line("GPU:", setting.gpu.empty() ? "none used" : setting.gpu);
}

/// All cases of one mesh that were measured.
std::string mesh_text(const ExperimentResult& result, const MeshCounts& mesh) {
  std::string title = fmt::format("\n{}: {} vertices, {} triangles\n", size_text(mesh.asked), count_text(mesh.vertices),
                                  count_text(mesh.triangles));
  if (!any_measured_on(result, mesh)) {
    return title + "nothing was measured\n";
  }
  TextColumns times({{0, Align::left}, {1, Align::left}, {gap}, {gap}});
  times.add_row({"", "form", "smoothing", "together"});
  TextColumns rest({{0, Align::left}, {1, Align::left}, {gap}, {1}, {1}, {gap}, {gap}});
  rest.add_row({"", "form", "sweeps", "topology", "transfer", "smoothing", "together"});
  for (const Row& row : result.rows) {
    if (row.vertices == mesh.asked && row.measured) {
      const Measurement& measured = *row.measured;
      times.add_row({name_of(row.what), form_of(row.what), measured.smoothing.text(), measured.together.text()});
      rest.add_row({name_of(row.what), form_of(row.what), sweeps_text(measured.sweeps),
                    three_digits(measured.topology.median),
                    runs_on_device(row.what.version) ? three_digits(measured.transfer.median) : "-",
                    median_or_dash(result.speedup(row.vertices, row.what)),
                    median_or_dash(result.speedup_together(row.vertices, row.what))});
    }
  }
  return title + times.text({{2, 3, "milliseconds, median (least-most)"}}) + '\n' +
         rest.text({{3, 4, "milliseconds"}, {5, 6, "times faster"}});
}

/// A row for the medians and, where anything was measured, one for the spreads.
void add_rows_here(TextColumns& columns, const TableRow& row, std::string label) {
  const std::array<const std::optional<Spread>*, 5> cells{&row.serial_ms, &row.aos_ms, &row.soa_ms, &row.aos_speedup,
                                                          &row.soa_speedup};
  std::vector<std::string> medians{size_text(row.vertices), std::move(label)};
  std::vector<std::string> spreads{"", "spread"};
  bool any = false;
  for (const std::optional<Spread>* const cell : cells) {
    medians.push_back(median_or_dash(*cell));
    spreads.push_back(*cell ? (*cell)->range_text() : "-");
    any = any || cell->has_value();
  }
  columns.add_row(std::move(medians));
  if (any) {
    columns.add_row(std::move(spreads));
  }
}

std::string table_text(const Table& table) {
  TextColumns columns({{0, Align::left}, {1, Align::left}, {gap}, {gap}, {gap}, {gap}, {gap}});
  const bool is_of_paper = table.number > 0;
  columns.add_row({"size", "", "serial CPU", "AoS", "SoA", "AoS", "SoA"});
  for (const TableRow& row : table.rows) {
    add_rows_here(columns, row, is_of_paper ? "here" : "");
    if (row.published != nullptr) {
      columns.add_row({"", "paper", fmt::format("{}", row.published->cpu_ms),
                       fmt::format("{:.1f}", row.published->aos_ms), fmt::format("{:.1f}", row.published->soa_ms),
                       fmt::format("{:.2f}", row.published->aos_speedup),
                       fmt::format("{:.2f}", row.published->soa_speedup)});
    }
  }
  return "\n" + table.title + "\n" + columns.text({{2, 4, "milliseconds"}, {5, 6, "speedup"}});
}

/// The paper's tables, all of them; of the others those in which something was measured.
std::string tables_text(const ExperimentReport& report) {
  std::string of_paper;
  std::string beyond;
  for (const Table& table : report.tables) {
    if (table.number > 0) {
      of_paper += table_text(table);
    } else if (table.missing_reason.empty()) {
      beyond += table_text(table);
    }
  }
  std::string text;
  if (!of_paper.empty()) {
    text +=
        '\n' +
        wrapped(fmt::format("The paper's tables: milliseconds of smoothing here, running time in the paper ({}; {})",
                            published_gpu, published_cpu),
                "", "  ") +
        of_paper;
  }
  return beyond.empty() ? text : text + "\nBeyond the paper\n" + beyond;
}

std::string conclusion_text(const Conclusion& conclusion) {
  std::string text = wrapped(fmt::format("{}. {}", conclusion.number, conclusion.claim), "", "   ");
  text += fmt::format("   -> {}\n", to_string(conclusion.verdict));
  for (const std::string& finding : conclusion.findings) {
    text += wrapped(finding, "   ", "     ");
  }
  return text;
}

}  // namespace

std::string text_of(const ExperimentReport& report) {
  std::string text = heading(report);
  for (const MeshCounts& mesh : report.result.meshes) {
    text += mesh_text(report.result, mesh);
  }
  text += tables_text(report);
  text += "\nThe paper's claims on this machine\n";
  for (const Conclusion& conclusion : report.conclusions) {
    text += '\n' + conclusion_text(conclusion);
  }
  text += "\nRemarks\n";
  for (const std::string& remark : remarks_on(report)) {
    text += wrapped(remark, "- ", "  ");
  }
  return text;
}

}  // namespace trismooth::experiments

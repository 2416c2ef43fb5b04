#include "trismooth/quality/report_text.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "trismooth/pipeline/bench/report.h"
#include "trismooth/pipeline/bench/wording.h"
#include "trismooth/pipeline/version.h"
#include "trismooth/quality/text_columns.h"

namespace trismooth::bench {

namespace {

using Align = TextColumns::Align;

constexpr std::size_t gap = 3;
constexpr std::size_t line_width = 100;

/// The text in lines of at most line_width, the second and later ones indented.
std::string wrapped(std::string_view text, std::string_view first_indent, std::string_view indent) {
  std::string lines;
  std::string line(first_indent);
  bool is_empty = true;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (!is_empty && line.size() + 1 + word.size() > line_width) {
      lines += line + '\n';
      line = indent;
      is_empty = true;
    }
    line.append(is_empty ? "" : " ").append(word);
    is_empty = false;
  }
  return lines + line + '\n';
}

std::string text_or_dash(const std::optional<Spread>& spread) {
  return spread ? spread->text() : "-";
}

std::string median_or_dash(const std::optional<Spread>& spread) {
  return spread ? three_digits(spread->median) : "-";
}

std::string heading(const Report& report) {
  const ExperimentOptions& options = report.result.options;
  const Setting& setting = report.setting;
  std::string text = fmt::format("trismooth {}: the experiments of the paper, {} precision, up to {} each, {}\n",
                                 version(), to_string(options.precision), runs_text(options.runs), setting.date);
  text += fmt::format("CPU:  {}{}\n", setting.cpu,
                      setting.threads > 0 ? fmt::format(", {} threads", setting.threads) : std::string{});
  return text + fmt::format("GPU:  {}\n", setting.gpu.empty() ? "none used" : setting.gpu);
}

/// All cases of one mesh that were measured.
std::string mesh_text(const ExperimentResult& result, const MeshCounts& mesh) {
  std::string title = fmt::format("\n{}: {} vertices, {} triangles\n", size_text(mesh.asked), count_text(mesh.vertices),
                                  count_text(mesh.triangles));
  if (!any_measured_on(result, mesh)) {
    return title + "nothing was measured\n";
  }
  TextColumns columns({{0, Align::left}, {gap, Align::left}, {gap}, {gap}, {gap}, {gap}, {gap}, {gap}, {gap}});
  columns.add_row({"", "form", "topology", "transfer", "smoothing", "together", "sweeps", "smoothing", "together"});
  for (const Row& row : result.rows) {
    if (row.vertices == mesh.asked && row.measured) {
      const Measurement& measured = *row.measured;
      columns.add_row({name_of(row.what), form_of(row.what), three_digits(measured.topology.median),
                       runs_on_device(row.what.version) ? three_digits(measured.transfer.median) : "-",
                       measured.smoothing.text(), measured.together.text(), sweeps_text(measured.sweeps),
                       median_or_dash(result.speedup(row.vertices, row.what)),
                       median_or_dash(result.speedup_together(row.vertices, row.what))});
    }
  }
  return title + columns.text({{2, 5, "milliseconds, median (least-most)"}, {7, 8, "times faster"}});
}

std::string table_text(const Table& table) {
  TextColumns columns({{0, Align::left}, {gap, Align::left}, {gap}, {gap}, {gap}, {gap}, {gap}});
  const bool is_of_paper = table.number > 0;
  columns.add_row({"size", "", "serial CPU ms", "AoS ms", "SoA ms", "AoS speedup", "SoA speedup"});
  for (const TableRow& row : table.rows) {
    columns.add_row({size_text(row.vertices), is_of_paper ? "here" : "", text_or_dash(row.serial_ms),
                     text_or_dash(row.aos_ms), text_or_dash(row.soa_ms), text_or_dash(row.aos_speedup),
                     text_or_dash(row.soa_speedup)});
    if (row.published != nullptr) {
      columns.add_row({"", "paper", fmt::format("{}", row.published->cpu_ms),
                       fmt::format("{:.1f}", row.published->aos_ms), fmt::format("{:.1f}", row.published->soa_ms),
                       fmt::format("{:.2f}", row.published->aos_speedup),
                       fmt::format("{:.2f}", row.published->soa_speedup)});
    }
  }
  return "\n" + table.title + "\n" + columns.text();
}

/// The paper's tables, all of them; of the others those in which something was measured.
std::string tables_text(const Report& report) {
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
    text += fmt::format("\nThe paper's tables: milliseconds of smoothing here, running time in the paper ({}; {})\n",
                        published_gpu, published_cpu) +
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

std::string text_of(const Report& report) {
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

}  // namespace trismooth::bench

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/text/quality_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/digits.h"
#include "trismooth/quality/size_ratio.h"
#include "trismooth/quality/text/report_text.h"
#include "trismooth/quality/text/text_columns.h"

namespace trismooth {

namespace {

using Align = TextColumns::Align;

constexpr std::size_t line_columns = 80;
constexpr std::size_t number_columns = 9;

/// number_text() in no more columns than a table has for it.
std::string cell_text(double value, int digits) {
  std::string text = number_text(value, digits);
  return text.size() <= number_columns ? text : scientific_digits(value, 1);
}

/// ">= 30": what counts as acceptable.
std::string acceptable_text(const MetricInfo& metric) {
  return metric.larger_is_better ? ">= " + shortest_digits(metric.acceptable_low)
                                 : "<= " + shortest_digits(metric.acceptable_high);
}

/// A row for each of the metrics, of which summary(metric) is what it comes to.
template <class Metrics, class Summary>
std::string rows_of_metrics(const Metrics& metrics, bool has_one_range, const Summary& summary_of_metric) {
  TextColumns columns({{0, Align::left}, {2}, {2}, {2}, {2}, {2}, {2, Align::left}});
  columns.add_row({"metric", "min", "mean", "max", "stddev", "acceptable", has_one_range ? "where" : ""});
  for (const MetricInfo& metric : metrics) {
    const MetricSummary& summary = summary_of_metric(metric);
    const int digits = decimals(metric.metric);
    columns.add_row({std::string(metric.name), cell_text(summary.min, digits), cell_text(summary.mean, digits),
                     cell_text(summary.max, digits), cell_text(summary.stddev, digits),
                     percent_text(summary.acceptable_fraction) + " %", has_one_range ? acceptable_text(metric) : ""});
  }
  return columns.text();
}

std::string kind_alone(const KindQuality& kind) {
  return std::string(kind.kind == ElementKind::triangle ? "triangles" : "quadrilaterals") + " alone\n";
}

std::string metrics_text(const QualityReport& report) {
  std::vector<MetricInfo> shown;
  std::ranges::transform(metrics_of(report), std::back_inserter(shown),
                         [](const MetricInfo* metric) { return *metric; });
  std::string text = rows_of_metrics(
      shown,
      report.kinds.size() < 2, [&](const MetricInfo& metric) -> const auto& { return summary_of(report, metric); });
  if (report.kinds.size() < 2) {
    return text;
  }
  for (const KindQuality& of_kind : report.kinds) {
    text += "\n" + kind_alone(of_kind) +
            rows_of_metrics(
                all_metrics(of_kind.kind),
                true, [&](const MetricInfo& metric) -> const auto& { return of_kind[metric.metric]; });
  }
  return text;
}

/// By how much the value changed, in two digits, so that no change is too small to be seen.
std::string change_text(double before, double after) {
  const double change = after - before;
  if (std::isnan(change) || change == 0) {
    return "";
  }
  const std::string sign = change > 0 ? "+" : "";
  std::string text = sign + general_digits(change, 2);
  return text.size() <= number_columns - 1 ? text : sign + scientific_digits(change, 0);
}

std::string table_of_both(const QualityReport& before, const QualityReport& after) {
  TextColumns columns({{0, Align::left}, {1, Align::left}, {2}, {2}, {2}, {2}, {2}, {2, Align::left}});
  columns.add_row({"metric", "", "min", "mean", "max", "ok %", "worst by"});
  for (const MetricInfo* const shown : metrics_of(after)) {
    const MetricInfo& metric = *shown;
    const int digits = decimals(metric.metric);
    const auto row = [&](std::string name, std::string_view when, const MetricSummary& summary) {
      return std::vector<std::string>{std::move(name),
                                      std::string(when),
                                      cell_text(summary.min, digits),
                                      cell_text(summary.mean, digits),
                                      cell_text(summary.max, digits),
                                      percent_text(summary.acceptable_fraction)};
    };
    const MetricSummary& from = summary_of(before, metric);
    const MetricSummary& to = summary_of(after, metric);
    columns.add_row(row(std::string(metric.name), "before", from));
    std::vector<std::string> last = row("", "after", to);
    last.push_back(change_text(worst_of(metric.metric, from), worst_of(metric.metric, to)));
    last.emplace_back(verdict(metric.metric, from, to));
    columns.add_row(std::move(last));
  }
  return columns.text();
}

std::string metrics_text(const QualityReport& before, const QualityReport& after) {
  std::string text = table_of_both(before, after);
  for (std::size_t k = 0; before.kinds.size() > 1 && k < before.kinds.size(); ++k) {
    text += "\n" + kind_alone(before.kinds[k]) + table_of_both(report_of(before.kinds[k]), report_of(after.kinds[k]));
  }
  return text + "ok %: of the elements, in the range that Verdict's manual calls acceptable\n";
}

/// A bar for `count` out of `largest`; a count that is not 0 shows at least a dot.
std::string bar(std::int64_t count, std::int64_t largest, std::size_t width) {
  const auto length = static_cast<std::size_t>(
      std::lround(static_cast<double>(width) * static_cast<double>(count) / static_cast<double>(largest)));
  return count > 0 && length == 0 ? "." : std::string(length, '#');
}

/// The number of inverted triangles and the bins from the first to the last that hold one, bars on one scale.
std::string histogram_text(const std::vector<const QualityReport*>& reports) {
  std::size_t first = shape_bins;
  std::size_t last = 0;
  std::int64_t largest = 1;
  bool any_inverted = false;
  for (const QualityReport* const report : reports) {
    for (std::size_t bin = 0; bin < shape_bins; ++bin) {
      if (report->shape_histogram[bin] > 0) {
        first = std::min(first, bin);
        last = std::max(last, bin);
      }
      largest = std::max(largest, report->shape_histogram[bin]);
    }
    largest = std::max(largest, report->inverted);
    any_inverted = any_inverted || report->inverted > 0;
  }

  const std::size_t label_width = std::string_view("0.00 to 0.05").size();
  const std::size_t count_width = std::max(count_text(largest).size(), std::string_view("before").size());
  const std::size_t gaps = 4;
  const std::size_t bar_width = (line_columns - label_width) / reports.size() - gaps - count_width;
  const bool is_single = reports.size() == 1;
  TextColumns columns({{0, Align::left}, {2}, {2, Align::left}, {2}, {2, Align::left}});
  columns.add_row(is_single ? std::vector<std::string>{"shape", "count"}
                            : std::vector<std::string>{"shape", "before", std::string(bar_width, ' '), "after"});
  const auto add_row = [&](std::string label, const auto& count_in) {
    std::vector<std::string> cells{std::move(label)};
    for (const QualityReport* const report : reports) {
      cells.push_back(count_text(count_in(*report)));
      cells.push_back(bar(count_in(*report), largest, bar_width));
    }
    columns.add_row(std::move(cells));
  };
  if (any_inverted) {
    add_row("below 0", [](const QualityReport& report) { return report.inverted; });
  }
  for (std::size_t bin = first; bin <= last; ++bin) {
    const auto limit = [](std::size_t i) { return static_cast<double>(i) / static_cast<double>(shape_bins); };
    add_row(fixed_digits(limit(bin), 2) + " to " + fixed_digits(limit(bin + 1), 2),
            [bin](const QualityReport& report) { return report.shape_histogram[bin]; });
  }
  return columns.text();
}

/// The worst elements of one report below `title`.
std::string worst_text(const QualityReport& report, std::span<const std::string> region_names, std::string_view title) {
  const bool has_regions = !region_names.empty();
  std::vector<TextColumns::Column> shown{{0}, {3}, {2}, {2, Align::left}, {2, Align::left}};
  std::vector<std::string> head{"", "element", "shape", "centroid"};
  if (has_regions) {
    shown.push_back({2, Align::left});
    head.emplace_back("region");
  }
  TextColumns columns(shown);
  columns.add_row(std::move(head));
  for (std::size_t rank = 0; rank < report.worst.size(); ++rank) {
    const WorstElement& element = report.worst[rank];
    std::vector<std::string> row{
        std::to_string(rank + 1), std::to_string(element.element), number_text(element.shape, 6),
        "(" + general_digits(element.centroid.x, 8) + ", " + general_digits(element.centroid.y, 8) + ")"};
    if (has_regions) {
      row.push_back(element.region < 0 ? "" : region_names[static_cast<std::size_t>(element.region)]);
    }
    row.emplace_back(element.all_fixed ? "all fixed" : "");
    columns.add_row(std::move(row));
  }
  return columns.text({{0, 3, title}});
}

std::string worst_text(const std::vector<const QualityReport*>& reports, std::span<const std::string> region_names) {
  std::string text = reports.size() == 1 ? worst_text(*reports[0], region_names, "worst")
                                         : worst_text(*reports[0], region_names, "worst before") + '\n' +
                                               worst_text(*reports[1], region_names, "worst after");
  const bool any_fixed = std::ranges::any_of(reports, [](const QualityReport* report) {
    return std::ranges::any_of(report->worst, &WorstElement::all_fixed);
  });
  if (any_fixed) {
    text += "all fixed: none of its corners may move, so no smoothing can change it\n";
  }
  return text;
}

std::string counts_text(const std::vector<const QualityReport*>& reports) {
  TextColumns columns({{0, Align::left}, {3}, {3}});
  if (reports.size() > 1) {
    columns.add_row({"", "before", "after"});
  }
  const auto add_row = [&](std::string_view label, std::int64_t QualityReport::*count) {
    std::vector<std::string> cells{std::string(label)};
    for (const QualityReport* const report : reports) {
      cells.push_back(count_text(report->*count));
    }
    columns.add_row(std::move(cells));
  };
  const auto has_any = [&](std::int64_t QualityReport::*count) {
    return std::ranges::any_of(reports, [&](const QualityReport* report) { return report->*count > 0; });
  };
  const bool has_quadrilaterals = has_any(&QualityReport::quadrilaterals);
  if (!has_quadrilaterals || has_any(&QualityReport::triangles)) {
    add_row("triangles", &QualityReport::triangles);
  }
  if (has_quadrilaterals) {
    add_row("quadrilaterals", &QualityReport::quadrilaterals);
  }
  add_row("inverted", &QualityReport::inverted);
  add_row("degenerate", &QualityReport::degenerate);
  return columns.text();
}

}  // namespace

std::string format_table(const QualityReport& before, const QualityReport* after,
                         std::span<const std::string> region_names) {
  std::vector<const QualityReport*> reports{&before};
  if (after != nullptr) {
    reports.push_back(after);
  }
  std::string text = counts_text(reports);
  if (before.elements() == 0) {
    return text;
  }
  text += '\n' + (after == nullptr ? metrics_text(before) : metrics_text(before, *after));
  text += '\n' + histogram_text(reports);
  if (!before.worst.empty()) {
    text += '\n' + worst_text(reports, region_names);
  }
  return text;
}

std::string format_summary(const QualityReport& before, const QualityReport& after) {
  constexpr std::size_t longest_worst = 12;
  TextColumns columns({{0, Align::left}, {3}, {2}, {4}, {2}, {3, Align::left}});
  columns.add_row({"", "before", "after", "before", "after"});
  for (const Metric metric : {Metric::shape, Metric::min_angle, Metric::max_angle}) {
    const MetricSummary& from = before[metric];
    const MetricSummary& to = after[metric];
    const int digits = decimals(metric);
    TextPair worst = distinct_texts(worst_of(metric, from), worst_of(metric, to), digits);
    MetricSummary judged = to;
    if (std::max(worst.before.size(), worst.after.size()) > longest_worst) {
      // What changes behind all digits that are shown does not change: "worse" beside equal numbers would only alarm.
      judged.min = from.min;
      judged.max = from.max;
      worst = {cell_text(worst_of(metric, from), digits), cell_text(worst_of(metric, to), digits)};
    }
    columns.add_row({std::string(info(metric).name), std::move(worst.before), std::move(worst.after),
                     cell_text(from.mean, digits), cell_text(to.mean, digits),
                     std::string(verdict(metric, from, judged))});
  }
  columns.add_row({"inverted", count_text(before.inverted), count_text(after.inverted)});
  if (before.degenerate > 0 || after.degenerate > 0) {
    columns.add_row({"degenerate", count_text(before.degenerate), count_text(after.degenerate)});
  }
  return columns.text({{1, 2, "worst"}, {3, 4, "mean"}});
}

std::ostream& operator<<(std::ostream& stream, const QualityReport& report) {
  return stream << format_table(report);
}

}  // namespace trismooth

#include "trismooth/quality/quality_table.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/quality/report_text.h"
#include "trismooth/quality/text_columns.h"

namespace trismooth {

namespace {

using Align = TextColumns::Align;

/// ">= 30 degrees": what counts as acceptable.
std::string acceptable_text(const MetricInfo& metric) {
  const std::string limit = metric.larger_is_better ? fmt::format(">= {}", metric.acceptable_low)
                                                    : fmt::format("<= {}", metric.acceptable_high);
  return metric.unit == "degrees" ? limit + " degrees" : limit;
}

std::string metrics_text(const QualityReport& report) {
  TextColumns columns({{0, Align::left}, {3}, {3}, {3}, {3}, {3}, {2, Align::left}});
  columns.add_row({"metric", "min", "mean", "max", "stddev", "acceptable %", "where"});
  for (const MetricInfo& metric : all_metrics()) {
    const MetricSummary& summary = report[metric.metric];
    const int digits = decimals(metric.metric);
    columns.add_row({std::string(metric.name), number_text(summary.min, digits), number_text(summary.mean, digits),
                     number_text(summary.max, digits), number_text(summary.stddev, digits),
                     percent_text(summary.acceptable_fraction), acceptable_text(metric)});
  }
  return columns.text();
}

std::string metrics_text(const QualityReport& before, const QualityReport& after) {
  TextColumns columns({{0, Align::left}, {3}, {1}, {3}, {1}, {3}, {1}, {3}, {2}, {2, Align::left}});
  columns.add_row({"metric", "before", "after", "before", "after", "before", "after", "before", "after"});
  for (const MetricInfo& metric : all_metrics()) {
    const MetricSummary& from = before[metric.metric];
    const MetricSummary& to = after[metric.metric];
    const int digits = decimals(metric.metric);
    TextPair min{number_text(from.min, digits), number_text(to.min, digits)};
    TextPair max{number_text(from.max, digits), number_text(to.max, digits)};
    (metric.larger_is_better ? min : max) =
        distinct_texts(worst_of(metric.metric, from), worst_of(metric.metric, to), digits);
    columns.add_row({std::string(metric.name), min.before, min.after, number_text(from.mean, digits),
                     number_text(to.mean, digits), max.before, max.after, percent_text(from.acceptable_fraction),
                     percent_text(to.acceptable_fraction), std::string(verdict(metric.metric, from, to))});
  }
  return columns.text({{1, 2, "min"}, {3, 4, "mean"}, {5, 6, "max"}, {7, 8, "acceptable %"}});
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

  const std::size_t bar_width = 60 / reports.size();
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
    add_row(fmt::format("{:.2f} to {:.2f}", limit(bin), limit(bin + 1)),
            [bin](const QualityReport& report) { return report.shape_histogram[bin]; });
  }
  return columns.text();
}

std::string worst_text(const std::vector<const QualityReport*>& reports) {
  TextColumns columns({{0}, {3}, {2}, {2, Align::left}, {4}, {2}, {2, Align::left}});
  std::vector<std::string> header{"worst"};
  std::size_t ranks = 0;
  for (const QualityReport* const report : reports) {
    header.insert(header.end(), {"element", "shape", "centroid"});
    ranks = std::max(ranks, report->worst.size());
  }
  columns.add_row(std::move(header));
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    std::vector<std::string> cells{std::to_string(rank + 1)};
    for (const QualityReport* const report : reports) {
      if (rank < report->worst.size()) {
        const WorstElement& element = report->worst[rank];
        cells.insert(cells.end(), {std::to_string(element.triangle), number_text(element.shape, 6),
                                   fmt::format("({:.8g}, {:.8g})", element.centroid.x, element.centroid.y)});
      } else {
        cells.insert(cells.end(), 3, "");
      }
    }
    columns.add_row(std::move(cells));
  }
  return reports.size() == 1 ? columns.text() : columns.text({{1, 3, "before"}, {4, 6, "after"}});
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
  add_row("triangles", &QualityReport::triangles);
  add_row("inverted", &QualityReport::inverted);
  add_row("degenerate", &QualityReport::degenerate);
  return columns.text();
}

}  // namespace

std::string format_table(const QualityReport& before, const QualityReport* after) {
  std::vector<const QualityReport*> reports{&before};
  if (after != nullptr) {
    reports.push_back(after);
  }
  std::string text = counts_text(reports);
  if (before.triangles == 0) {
    return text;
  }
  text += '\n' + (after == nullptr ? metrics_text(before) : metrics_text(before, *after));
  text += '\n' + histogram_text(reports);
  if (!before.worst.empty()) {
    text += '\n' + worst_text(reports);
  }
  return text;
}

std::ostream& operator<<(std::ostream& stream, const QualityReport& report) {
  return stream << format_table(report);
}

}  // namespace trismooth

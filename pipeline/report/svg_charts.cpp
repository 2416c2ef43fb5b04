// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/svg_charts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "trismooth/quality/text/report_text.h"

namespace trismooth {

namespace {

// Heights are in pixels, places along the width in hundredths of it: so the letters are of one size however wide the
// window is. What stands left of 0 is in the margin that the style sheet leaves.
constexpr double chart_height = 290;
constexpr double top = 34;
constexpr double bottom = chart_height - 44;

std::string chart(std::string_view label, std::string_view y_title, const std::string& content) {
  return fmt::format(
      "<svg class=\"chart\" width=\"100%\" height=\"{}\" role=\"img\" aria-label=\"{}\">\n"
      "<text class=\"axis\" x=\"-48\" y=\"14\">{}</text>\n{}</svg>\n",
      chart_height, label, y_title, content);
}

std::string percent(double share) {
  return fmt::format("{:.3f}%", 100 * share);
}

std::string x_label(double share, std::string_view content) {
  return fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", percent(share), bottom + 18,
                     content);
}

std::string grid_line(double y, std::string_view label) {
  return fmt::format(
      "<line class=\"grid\" x1=\"0\" y1=\"{0:.1f}\" x2=\"100%\" y2=\"{0:.1f}\"/>\n"
      "<text class=\"count\" x=\"-8\" y=\"{1:.1f}\" text-anchor=\"end\">{2}</text>\n",
      y, y + 4, label);
}

std::string axis_title(std::string_view title) {
  return fmt::format("<text class=\"axis\" x=\"50%\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", chart_height - 6,
                     title);
}

/// Counts on a logarithmic scale, from bottom to top. 0 has a place of its own, half a decade below 1, so that one
/// element is seen beside a million, and none is seen as none.
class CountScale {
 public:
  explicit CountScale(std::int64_t largest)
      : decades_(std::max(1, static_cast<int>(std::ceil(std::log10(static_cast<double>(largest)))))) {}

  double y_of(std::int64_t count) const {
    const double units_per_decade = (bottom - top) / (decades_ + zero_gap);
    return count == 0 ? bottom : bottom - (zero_gap + std::log10(static_cast<double>(count))) * units_per_decade;
  }

  std::string grid() const {
    std::string lines = grid_line(bottom, "0");
    std::int64_t count = 1;
    for (int decade = 0; decade <= decades_; ++decade, count *= 10) {
      lines += grid_line(y_of(count), size_text(count));
    }
    return lines;
  }

 private:
  static constexpr double zero_gap = 0.5;
  int decades_;
};

/// A round step that divides `range` into `parts` parts at most: 1, 2 or 5 times a power of ten, from 1 up.
std::int64_t round_step(std::int64_t range, std::int64_t parts) {
  std::int64_t power = 1;
  for (;; power *= 10) {
    for (const std::int64_t step : {power, 2 * power, 5 * power}) {
      if (step * parts >= range) {
        return step;
      }
    }
  }
}

/// The counts of one report, as one colour of bars.
struct Series {
  std::string_view style;    ///< the class of the bars
  std::string_view tooltip;  ///< between the bar's label and its count
  std::vector<std::int64_t> counts;
};

Series make_series(const QualityReport& report, bool with_inverted, std::string_view style, std::string_view tooltip) {
  Series series{style, tooltip, {report.shape_histogram.begin(), report.shape_histogram.end()}};
  if (with_inverted) {
    series.counts.insert(series.counts.begin(), report.inverted);
  }
  return series;
}

std::string bin_label(std::size_t bin) {
  const auto limit = [](std::size_t i) { return static_cast<double>(i) / static_cast<double>(shape_bins); };
  return fmt::format("{:.2f} to {:.2f}", limit(bin), limit(bin + 1));
}

std::string rectangle(std::string_view series, std::string_view tooltip, double x, double width, double y) {
  return fmt::format(
      "<rect class=\"{}\" x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\"><title>{}</title></rect>\n", series,
      percent(x), y, percent(width), bottom - y, tooltip);
}

}  // namespace

std::string shape_histogram_svg(const QualityReport& before, const QualityReport* after) {
  const bool any_inverted = before.inverted > 0 || (after != nullptr && after->inverted > 0);
  std::vector<Series> all_series;
  if (after == nullptr) {
    all_series = {make_series(before, any_inverted, "after", "")};
  } else {
    all_series = {make_series(before, any_inverted, "before", ", before"),
                  make_series(*after, any_inverted, "after", ", after")};
  }
  std::int64_t largest = 1;
  for (const Series& series : all_series) {
    largest = std::max(largest, *std::ranges::max_element(series.counts));
  }
  const CountScale scale(largest);
  std::string content = scale.grid();
  const std::size_t places = all_series.front().counts.size();
  const double place = 1 / static_cast<double>(places);
  const double gap = 0.14 * place;
  const double bar_width = (place - gap) / static_cast<double>(all_series.size());
  for (std::size_t i = 0; i < places; ++i) {
    const std::string label = !any_inverted ? bin_label(i) : i == 0 ? "inverted" : bin_label(i - 1);
    double x = static_cast<double>(i) * place + gap / 2;
    for (const Series& series : all_series) {
      if (series.counts[i] > 0) {
        content += rectangle(series.style, fmt::format("{}{}: {}", label, series.tooltip, count_text(series.counts[i])),
                             x, bar_width, scale.y_of(series.counts[i]));
      }
      x += bar_width;
    }
  }
  const double zero = any_inverted ? place : 0;
  if (any_inverted) {
    content += x_label(place / 2, "&lt; 0");
  }
  constexpr int labels = 10;
  for (int i = any_inverted ? 1 : 0; i <= labels; ++i) {
    const double share = static_cast<double>(i) / labels;
    content += x_label(zero + share * (1 - zero), fmt::format("{:.1f}", share));
  }
  return chart("Histogram of shape", "elements, on a logarithmic scale", content + axis_title("shape (1 = best)"));
}

std::string convergence_svg(std::span<const SweepRecord> history) {
  std::int64_t largest = 1;
  for (const SweepRecord& record : history) {
    largest = std::max(largest, record.moved);
  }
  const CountScale scale(largest);
  const auto last = static_cast<double>(std::max<std::int64_t>(history.back().sweep, 2));
  const auto x_of = [&](std::int64_t sweep) { return (static_cast<double>(sweep) - 1) / (last - 1); };

  std::string content = scale.grid();
  constexpr std::int64_t most_labels = 6;
  const std::int64_t step = round_step(history.back().sweep, most_labels);
  content += x_label(x_of(1), "1");
  for (std::int64_t sweep = step == 1 ? 2 : step; sweep <= history.back().sweep; sweep += step) {
    content += x_label(x_of(sweep), std::to_string(sweep));
  }
  // More points than a chart has pixels would only make the page long.
  constexpr std::size_t most_points = 760;
  const std::size_t stride = 1 + history.size() / most_points;
  constexpr double curve_width = 1000;  // in units of a frame that is stretched to the chart's width
  std::string points;
  std::string dots;
  constexpr std::size_t most_dots = 80;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (i % stride != 0 && i + 1 != history.size()) {
      continue;
    }
    const SweepRecord& record = history[i];
    points += fmt::format("{:.1f},{:.1f} ", curve_width * x_of(record.sweep), scale.y_of(record.moved));
    if (history.size() <= most_dots) {
      dots += fmt::format(
          "<circle class=\"dot\" cx=\"{}\" cy=\"{:.1f}\" r=\"3\"><title>sweep {}: {} moved, {} "
          "evaluated</title></circle>\n",
          percent(x_of(record.sweep)), scale.y_of(record.moved), record.sweep, count_text(record.moved),
          count_text(record.evaluated));
    }
  }
  content += fmt::format(
      "<svg width=\"100%\" height=\"{0}\" viewBox=\"0 0 {1} {0}\" preserveAspectRatio=\"none\" overflow=\"visible\">"
      "<polyline class=\"curve\" vector-effect=\"non-scaling-stroke\" points=\"{2}\"/></svg>\n{3}",
      chart_height, curve_width, points, dots);
  return chart("Vertices moved in each sweep", "vertices moved, on a logarithmic scale", content + axis_title("sweep"));
}

}  // namespace trismooth

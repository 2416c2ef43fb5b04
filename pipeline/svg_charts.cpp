#include "trismooth/pipeline/svg_charts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "trismooth/quality/report_text.h"

namespace trismooth {

namespace {

// All lengths in the units of the viewBox, about a pixel each.
constexpr double chart_width = 760;
constexpr double chart_height = 270;
constexpr double left = 64;
constexpr double right = chart_width - 22;
constexpr double top = 14;
constexpr double bottom = chart_height - 44;

std::string chart(std::string_view label, const std::string& content) {
  return fmt::format("<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
                     chart_width, chart_height, label, content);
}

std::string text(double x, double y, std::string_view anchor, std::string_view content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, content);
}

std::string grid_line(double y, std::string_view label) {
  return fmt::format("<line class=\"grid\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", left, y, right,
                     y) +
         text(left - 8, y + 4, "end", label);
}

std::string axis_title(std::string_view title) {
  return text((left + right) / 2, chart_height - 6, "middle", title);
}

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

std::string rectangle(std::string_view series, std::string_view tooltip, double x, double width, double height) {
  return fmt::format(
      "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}</title></rect>\n",
      series, x, bottom - height, width, height, tooltip);
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
  const std::int64_t step = round_step(largest, 4);
  const std::int64_t highest = (largest + step - 1) / step * step;
  const double units_per_count = (bottom - top) / static_cast<double>(highest);

  std::string content;
  for (std::int64_t count = 0; count <= highest; count += step) {
    content += grid_line(bottom - static_cast<double>(count) * units_per_count, count_text(count));
  }
  const std::size_t places = all_series.front().counts.size();
  const double place = (right - left) / static_cast<double>(places);
  const double gap = 0.14 * place;
  const double bar_width = (place - gap) / static_cast<double>(all_series.size());
  for (std::size_t i = 0; i < places; ++i) {
    const std::string label = !any_inverted ? bin_label(i) : i == 0 ? "inverted" : bin_label(i - 1);
    double x = left + static_cast<double>(i) * place + gap / 2;
    for (const Series& series : all_series) {
      if (series.counts[i] > 0) {
        constexpr double least_height = 1.5;  // one triangle among a million is seen, too
        content +=
            rectangle(series.style, fmt::format("{}{}: {}", label, series.tooltip, count_text(series.counts[i])), x,
                      bar_width, std::max(static_cast<double>(series.counts[i]) * units_per_count, least_height));
      }
      x += bar_width;
    }
  }
  const double zero = any_inverted ? left + place : left;
  if (any_inverted) {
    content += text(left + place / 2, bottom + 18, "middle", "&lt; 0");
  }
  constexpr int labels = 10;
  for (int i = any_inverted ? 1 : 0; i <= labels; ++i) {
    const double share = static_cast<double>(i) / labels;
    content +=
        text(zero + share * (right - zero), bottom + 18, i == labels ? "end" : "middle", fmt::format("{:.1f}", share));
  }
  return chart("Histogram of shape", content + axis_title("shape of the triangles (1 = equilateral)"));
}

std::string convergence_svg(std::span<const SweepRecord> history) {
  std::int64_t largest = 1;
  for (const SweepRecord& record : history) {
    largest = std::max(largest, record.moved);
  }
  const int decades = std::max(1, static_cast<int>(std::ceil(std::log10(static_cast<double>(largest)))));
  // A sweep in which nothing moved has its own place, half a decade below one vertex.
  constexpr double zero_gap = 0.5;
  const double units_per_decade = (bottom - top) / (decades + zero_gap);
  const auto y_of = [&](std::int64_t moved) {
    return moved == 0 ? bottom : bottom - (zero_gap + std::log10(static_cast<double>(moved))) * units_per_decade;
  };
  const auto last = static_cast<double>(std::max<std::int64_t>(history.back().sweep, 2));
  const auto x_of = [&](std::int64_t sweep) {
    return left + (right - left) * (static_cast<double>(sweep) - 1) / (last - 1);
  };

  std::string content = grid_line(bottom, "0");
  const int every = decades > 5 ? 2 : 1;
  std::int64_t count = 1;
  for (int decade = 0; decade <= decades; ++decade, count *= 10) {
    if (decade % every == 0) {
      content += grid_line(y_of(count), count_text(count));
    }
  }
  const std::int64_t step = round_step(history.back().sweep, 10);
  content += text(x_of(1), bottom + 18, "middle", "1");
  for (std::int64_t sweep = step == 1 ? 2 : step; sweep <= history.back().sweep; sweep += step) {
    content += text(x_of(sweep), bottom + 18, "middle", std::to_string(sweep));
  }
  // More points than the chart has pixels would only make the page long.
  const std::size_t stride = 1 + history.size() / static_cast<std::size_t>(chart_width);
  std::string points;
  std::string dots;
  constexpr std::size_t most_dots = 80;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (i % stride != 0 && i + 1 != history.size()) {
      continue;
    }
    const SweepRecord& record = history[i];
    points += fmt::format("{:.1f},{:.1f} ", x_of(record.sweep), y_of(record.moved));
    if (history.size() <= most_dots) {
      dots += fmt::format(
          "<circle class=\"dot\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"><title>sweep {}: {} moved, {} "
          "evaluated</title></circle>\n",
          x_of(record.sweep), y_of(record.moved), record.sweep, count_text(record.moved), count_text(record.evaluated));
    }
  }
  content += fmt::format("<polyline class=\"curve\" points=\"{}\"/>\n{}", points, dots);
  return chart("Vertices moved in each sweep", content + axis_title("sweep"));
}

}  // namespace trismooth

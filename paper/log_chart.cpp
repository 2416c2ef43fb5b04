// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/log_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "trismooth/paper/wording.h"
#include "trismooth/pipeline/report/html_text.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth::experiments {

namespace {

// All lengths in the units of the viewBox, about a pixel each.
constexpr double width_of_row = 1040;
constexpr double width_of_column = 400;
constexpr double margin = 12;
constexpr double panel_gap = 26;
constexpr double top = 38;
constexpr double bottom = 410;
constexpr double legend_gap_above = 72;
constexpr double panel_height = bottom + 56;  ///< with its title and that of x
constexpr double legend_row = 23;
constexpr double legend_sample = 46;
constexpr double legend_gap = 26;
constexpr double font_size = 13;
constexpr double title_size = 15;
constexpr double half_letter = 4.5;  ///< from the middle of a line of text to its base
constexpr double label_gap = 40;     ///< labels of ticks closer than this are left out

double width_of(const LogChart& chart) {
  return chart.arrangement == Arrangement::row ? width_of_row : width_of_column;
}

/// About. Wide for a sans serif font, since it is not known which one shows the chart.
double text_width(std::string_view text) {
  const auto letters = std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; });
  return 0.6 * font_size * static_cast<double>(letters);
}

std::string text(double x, double y, std::string_view anchor, std::string_view content, std::string_view more = "") {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     escape_html(content));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view style) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", x1, y1, x2, y2, style);
}

std::string grid_style(bool major) {
  return fmt::format(R"(stroke="{}" stroke-width="1")", major ? "#c6c6c6" : "#ececec");
}

std::string tick_text(double size) {
  return size_text(std::llround(size));
}

std::string value_text(double value) {
  constexpr double most_written_out = 1e9;
  return value < 1 || value > most_written_out ? fmt::format("{:g}", value)
                                               : count_text(static_cast<std::int64_t>(std::llround(value)));
}

// The steps of an axis are ..., 0.5, 1, 2, 5, 10, 20, 50, ..., numbered from 1 as 0.
constexpr int steps_per_decade = 3;

double step_value(int step) {
  static constexpr std::array<double, steps_per_decade> digits{1, 2, 5};
  const int decade = (step < 0 ? step - (steps_per_decade - 1) : step) / steps_per_decade;
  return digits[static_cast<std::size_t>(step - steps_per_decade * decade)] * std::pow(10.0, decade);
}

int first_step_from(double value) {
  int step = steps_per_decade * static_cast<int>(std::floor(std::log10(value)));
  while (step_value(step) < value) {
    ++step;
  }
  return step;
}

int last_step_to(double value) {
  int step = steps_per_decade * static_cast<int>(std::ceil(std::log10(value)));
  while (step_value(step) > value) {
    --step;
  }
  return step;
}

/// From the logarithms of numbers to places.
struct Axis {
  double low = 0;  ///< the logarithm
  double high = 0;
  double begin = 0;  ///< the place of `low`
  double end = 0;

  double place(double value) const { return begin + (std::log10(value) - low) / (high - low) * (end - begin); }
  double decade() const { return std::abs(end - begin) / (high - low); }
};

struct Tick {
  double value = 0;
  bool major = true;
  bool labelled = true;
};

/// At the decades, and at 2 and 5 between them where there is room.
std::vector<Tick> step_ticks(const Axis& axis) {
  constexpr double rounding = 1e-9;  // a step at the very end of the axis is on it
  const double closest_steps = std::log10(2) * axis.decade();
  const int every = static_cast<int>(std::ceil(label_gap / axis.decade()));
  std::vector<Tick> ticks;
  const int last = last_step_to(std::pow(10, axis.high + rounding));
  for (int step = first_step_from(std::pow(10, axis.low - rounding)); step <= last; ++step) {
    const bool decade = step % steps_per_decade == 0;
    if (decade || every == 1) {
      const bool labelled = decade ? step / steps_per_decade % every == 0 : closest_steps >= label_gap;
      ticks.push_back({step_value(step), decade, labelled});
    }
  }
  return ticks;
}

/// At the numbers themselves where these are few and their labels have room.
std::vector<Tick> ticks_at(const std::set<double>& values, const Axis& axis) {
  constexpr std::size_t most_values = 8;
  constexpr double space = 6;
  if (values.size() > most_values) {
    return step_ticks(axis);
  }
  std::vector<Tick> ticks;
  double free_from = -std::numeric_limits<double>::infinity();
  for (const double value : values) {
    const double half = text_width(tick_text(value)) / 2;
    if (axis.place(value) - half < free_from) {
      return step_ticks(axis);
    }
    free_from = axis.place(value) + half + space;
    ticks.push_back({value});
  }
  return ticks;
}

/// The shape around (0, 0), as large in area as the others of its kind look.
std::string_view shape(Marker marker) {
  switch (marker) {
    case Marker::square:
      return "M-4.3-4.3H4.3V4.3H-4.3Z";
    case Marker::diamond:
      return "M0-6.2L6.2 0 0 6.2-6.2 0Z";
    case Marker::triangle:
      return "M0-6.2L5.8 4.2H-5.8Z";
    case Marker::cross:
      return "M-3.4-5.6L0-2.2 3.4-5.6 5.6-3.4 2.2 0 5.6 3.4 3.4 5.6 0 2.2-3.4 5.6-5.6 3.4-2.2 0-5.6-3.4Z";
    default:
      return "M-4.8 0A4.8 4.8 0 1 1 4.8 0 4.8 4.8 0 1 1-4.8 0Z";
  }
}

/// `content` is the tooltip, as an element. A marker that is none takes the pointer all the same.
std::string marker(const LineStyle& style, double x, double y, std::string_view content) {
  const std::string paint = style.marker == Marker::none ? R"(fill="none" stroke="none" pointer-events="all")"
                            : style.filled ? fmt::format(R"(fill="{}" stroke="#fff" stroke-width="0.8")", style.colour)
                                           : fmt::format(R"(fill="#fff" stroke="{}" stroke-width="1.8")", style.colour);
  return fmt::format("<path transform=\"translate({:.2f} {:.2f}){}\" d=\"{}\" {}>{}</path>\n", x, y,
                     style.faint ? " scale(0.72)" : "", shape(style.marker), paint, content);
}

std::string line_paint(const LineStyle& style) {
  return fmt::format(R"(fill="none" stroke="{}" stroke-width="{}"{})", style.colour, style.faint ? 1.1 : 2,
                     style.dashed ? " stroke-dasharray=\"6 4\"" : "");
}

/// From the least to the most, with a cap on both ends; nothing where that would not be seen.
std::string whisker(const LineStyle& style, double x, double least, double most) {
  constexpr double cap = 3;
  if (std::abs(least - most) <= 1) {
    return "";
  }
  return fmt::format(
      "<path d=\"M{0:.2f} {2:.2f}H{1:.2f}M{3:.2f} {2:.2f}V{4:.2f}M{0:.2f} {4:.2f}H{1:.2f}\" fill=\"none\" "
      "stroke=\"{5}\" stroke-width=\"1.2\"/>\n",
      x - cap, x + cap, least, x, most, style.colour);
}

std::string series_svg(const ChartSeries& series, const Axis& x_axis, const Axis& y_axis) {
  LineStyle style = series.style;
  if (style.marker == Marker::none && series.points.size() == 1) {
    style.marker = Marker::circle;  // with neither line nor marker the point would not be seen
  }
  std::string path;
  std::string whiskers;
  std::string markers;
  for (const ChartPoint& point : series.points) {
    const double x = x_axis.place(point.x);
    const double y = y_axis.place(point.y.median);
    path += fmt::format("{}{:.2f},{:.2f}", path.empty() ? "" : " ", x, y);
    whiskers += whisker(style, x, y_axis.place(point.y.least), y_axis.place(point.y.most));
    markers += marker(style, x, y,
                      fmt::format("<title>{}, {}: {}</title>", escape_html(series.label), tick_text(point.x),
                                  escape_html(point.y.text())));
  }
  const std::string curve =
      series.points.size() < 2
          ? ""
          : fmt::format("<polyline points=\"{}\" {} stroke-linejoin=\"round\"/>\n", path, line_paint(style));
  return curve + whiskers + markers;
}

/// What a panel shares with those beside it.
struct Frame {
  Axis x_axis;  ///< of the first panel
  Axis y_axis;
  std::vector<Tick> x_ticks;
  std::vector<Tick> y_ticks;
};

std::string panel_svg(const LogChart& chart, const ChartPanel& panel, Axis x_axis, const Frame& frame) {
  const double middle = (x_axis.begin + x_axis.end) / 2;
  std::string svg =
      text(middle, top - 14, "middle", panel.title, fmt::format(R"( font-size="{}" font-weight="bold")", title_size));
  for (const bool major : {false, true}) {
    for (const Tick& tick : frame.y_ticks) {
      if (tick.major == major) {
        const double y = frame.y_axis.place(tick.value);
        svg += line(x_axis.begin, y, x_axis.end, y, grid_style(major));
      }
    }
    for (const Tick& tick : frame.x_ticks) {
      if (tick.major == major) {
        const double x = x_axis.place(tick.value);
        svg += line(x, top, x, bottom, grid_style(major));
      }
    }
  }
  for (const Tick& tick : frame.x_ticks) {
    if (tick.labelled) {
      svg += text(x_axis.place(tick.value), bottom + 19, "middle", tick_text(tick.value));
    }
  }
  svg += fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"none\" stroke=\"#555\"/>\n",
      x_axis.begin, top, x_axis.end - x_axis.begin, bottom - top);
  svg += text(middle, bottom + 42, "middle", chart.x_title);
  for (const bool faint : {true, false}) {
    for (const ChartSeries& series : panel.series) {
      if (series.style.faint == faint) {
        svg += series_svg(series, x_axis, frame.y_axis);
      }
    }
  }
  return svg;
}

/// One series of every label, in the order of the panels.
std::vector<const ChartSeries*> legend_entries(const LogChart& chart) {
  std::vector<const ChartSeries*> entries;
  for (const ChartPanel& panel : chart.panels) {
    for (const ChartSeries& series : panel.series) {
      const bool known = std::ranges::any_of(entries, [&](const auto* entry) { return entry->label == series.label; });
      if (!series.points.empty() && !known) {
        entries.push_back(&series);
      }
    }
  }
  return entries;
}

/// In columns from top to bottom: what comes together in the panels mostly stands together.
struct Legend {
  std::string svg;
  double height = 0;
};

Legend legend(const std::vector<const ChartSeries*>& entries, double width, double legend_top) {
  double entry_width = 0;
  for (const ChartSeries* entry : entries) {
    entry_width = std::max(entry_width, legend_sample + 8 + text_width(entry->label) + legend_gap);
  }
  const auto fitting = static_cast<std::size_t>((width - 2 * margin + legend_gap) / entry_width);
  const std::size_t rows = (entries.size() - 1) / std::max<std::size_t>(fitting, 1) + 1;
  const std::size_t columns = (entries.size() - 1) / rows + 1;
  const double block = static_cast<double>(columns) * entry_width - legend_gap;
  const double left = std::max(margin, (width - block) / 2);

  Legend legend{"", static_cast<double>(rows) * legend_row};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const LineStyle& style = entries[i]->style;
    const std::size_t column = i / rows;
    const double x = left + static_cast<double>(column) * entry_width;
    const double y = legend_top + static_cast<double>(i % rows) * legend_row;
    legend.svg += line(x, y, x + legend_sample, y, line_paint(style));
    if (style.marker != Marker::none) {
      legend.svg += marker(style, x + legend_sample / 2, y, "");
    }
    legend.svg += text(x + legend_sample + 8, y + half_letter, "start", entries[i]->label);
  }
  return legend;
}

/// The axes of the first of the panels, which hold all points of all panels.
Frame make_frame(const LogChart& chart) {
  std::set<double> sizes;
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const ChartPanel& panel : chart.panels) {
    for (const ChartSeries& series : panel.series) {
      for (const ChartPoint& point : series.points) {
        sizes.insert(point.x);
        least = std::min(least, point.y.least);
        most = std::max(most, point.y.most);
      }
    }
  }
  if (sizes.empty()) {
    throw std::invalid_argument("a chart needs a point");
  }
  if (!(*sizes.begin() > 0) || !(least > 0)) {
    throw std::invalid_argument("a logarithmic axis has no place for what is not positive");
  }
  Frame frame;
  // Markers at the ends of the range are not to touch the frame.
  const double room = std::pow(10, std::max(0.02, 0.025 * std::log10(most / least)));
  frame.y_axis = {std::log10(step_value(last_step_to(least / room))),
                  std::log10(step_value(first_step_from(most * room))), bottom, top};
  frame.y_ticks = step_ticks(frame.y_axis);

  double label_width = 0;
  for (const Tick& tick : frame.y_ticks) {
    label_width = std::max(label_width, tick.labelled ? text_width(value_text(tick.value)) : 0);
  }
  const double left = margin + title_size + 10 + label_width + 8;
  const auto panels = chart.arrangement == Arrangement::row ? static_cast<double>(chart.panels.size()) : 1;
  const double panel_width = (width_of(chart) - margin - left - (panels - 1) * panel_gap) / panels;
  const double low = std::log10(*sizes.begin());
  const double high = std::log10(*sizes.rbegin());
  const double beside = high > low ? 0.06 * (high - low) : 0.5;
  frame.x_axis = {low - beside, high + beside, left, left + panel_width};
  frame.x_ticks = ticks_at(sizes, frame.x_axis);
  return frame;
}

/// The labels of the first panel's y, and what it is.
std::string y_texts(const LogChart& chart, const Frame& frame) {
  std::string svg;
  for (const Tick& tick : frame.y_ticks) {
    if (tick.labelled) {
      svg += text(frame.x_axis.begin - 8, frame.y_axis.place(tick.value) + half_letter, "end", value_text(tick.value));
    }
  }
  const double title_x = margin + title_size - 2;
  const double middle = (top + bottom) / 2;
  return svg + text(title_x, middle, "middle", chart.y_title,
                    fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", title_x, middle));
}

std::string row_svg(const LogChart& chart, const Frame& frame) {
  std::string svg;
  Axis x_axis = frame.x_axis;
  for (const ChartPanel& panel : chart.panels) {
    svg += panel_svg(chart, panel, x_axis, frame);
    const double step = x_axis.end - x_axis.begin + panel_gap;
    x_axis.begin += step;
    x_axis.end += step;
  }
  return svg + y_texts(chart, frame);
}

std::string column_svg(const LogChart& chart, const Frame& frame) {
  std::string svg;
  double above = 0;
  for (const ChartPanel& panel : chart.panels) {
    svg += fmt::format("<g transform=\"translate(0 {:.2f})\">\n{}{}</g>\n", above,
                       panel_svg(chart, panel, frame.x_axis, frame), y_texts(chart, frame));
    above += panel_height;
  }
  return svg;
}

}  // namespace

std::string log_chart_svg(const LogChart& chart) {
  const Frame frame = make_frame(chart);
  const bool row = chart.arrangement == Arrangement::row;
  const std::string content = row ? row_svg(chart, frame) : column_svg(chart, frame);
  const double above_last = row ? 0 : panel_height * static_cast<double>(chart.panels.size() - 1);
  const double legend_top = above_last + bottom + legend_gap_above;
  const Legend below = legend(legend_entries(chart), width_of(chart), legend_top);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" id=\"{}\" viewBox=\"0 0 {} {}\" width=\"100%\" role=\"img\" "
      "aria-label=\"{}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{}\" fill=\"#222\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}{}</svg>\n",
      escape_html(chart.id), width_of(chart), legend_top + below.height, escape_html(chart.description), font_size,
      content, below.svg);
}

}  // namespace trismooth::experiments

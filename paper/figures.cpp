// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/figures.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "trismooth/paper/log_chart.h"

namespace trismooth::experiments {

namespace {

constexpr std::array all_versions{Version::serial, Version::cpu, Version::gpu, Version::cdp, Version::resident};
/// The colours can be told apart by everybody, the markers without colour.
LineStyle style_of(Version version) {
  switch (version) {
    case Version::serial:
      return {"#444444", Marker::cross};
    case Version::cpu:
      return {"#009e73", Marker::diamond};
    case Version::gpu:
      return {"#d55e00", Marker::circle};
    case Version::cdp:
      return {"#0072b2", Marker::square};
    case Version::resident:
      break;
  }
  return {"#8a2f8f", Marker::triangle};
}

LineStyle style_of(Version version, Form form) {
  LineStyle style = style_of(version);
  style.filled = form == Form::swap;
  style.dashed = form == Form::in_place;
  return style;
}

LineStyle faint_style(Version version, Form form) {
  LineStyle style = style_of(version, form);
  style.colour = "#9a9a9a";
  style.faint = true;
  return style;
}

std::string label_of(Version version, Form form) {
  return fmt::format("{}, Form {}", name_of(version), letter_of(form));
}

/// A line over the sizes; `value` answers nothing where there is no point.
template <class Value>
ChartSeries series_of(const ExperimentResult& result, std::string label, const LineStyle& style, const Value& value) {
  ChartSeries series{std::move(label), style, {}};
  std::vector<std::int64_t> sizes = result.options.sizes;
  std::ranges::sort(sizes);
  for (const std::int64_t size : sizes) {
    // No time at all, of a mesh without free vertices, has no place on a logarithmic axis.
    if (const std::optional<Spread> here = value(size); here && here->least > 0) {
      series.points.push_back({static_cast<double>(size), *here});
    }
  }
  return series;
}

/// A line of the paper's own, through what `value` answers for a case.
ChartSeries published_series(const ExperimentResult& result, std::string label, const LineStyle& style,
                             const Case& what, std::optional<double> (*value)(const Case&, std::int64_t)) {
  return series_of(result, std::move(label), style, [&](std::int64_t size) -> std::optional<Spread> {
    const std::optional<double> one = value(what, size);
    return one ? std::optional(Spread(*one, *one, *one)) : std::nullopt;
  });
}

/// Adds a panel whose lines are those that have a point.
void add_panel(LogChart& chart, std::string title, std::vector<ChartSeries> lines) {
  std::erase_if(lines, [](const ChartSeries& series) { return series.points.empty(); });
  chart.panels.push_back({std::move(title), std::move(lines)});
}

std::string svg_or_nothing(LogChart chart, Arrangement arrangement) {
  const bool any_measured = std::ranges::any_of(chart.panels, [](const ChartPanel& panel) {
    return std::ranges::any_of(panel.series, [](const ChartSeries& series) { return !series.style.faint; });
  });
  chart.arrangement = arrangement;
  if (arrangement == Arrangement::column) {
    chart.id += "-narrow";
  }
  return any_measured ? log_chart_svg(chart) : std::string{};
}

}  // namespace

std::string forms_figure(const ExperimentResult& result, Arrangement arrangement) {
  LogChart chart{"figure-3",
                 "Milliseconds of smoothing over the number of vertices, for each version in both forms",
                 "vertices",
                 "smoothing, ms",
                 {}};
  for (const Layout layout : {Layout::aos, Layout::soa}) {
    std::vector<ChartSeries> lines;
    for (const Version version : all_versions) {
      for (const Form form : forms) {
        lines.push_back(series_of(result, label_of(version, form), style_of(version, form), [&](std::int64_t size) {
          return result.smoothing_ms(size, case_of_paper(version, form, layout));
        }));
      }
    }
    for (const Version version : {Version::gpu, Version::cdp}) {
      for (const Form form : forms) {
        lines.push_back(published_series(result, "paper: " + label_of(version, form), faint_style(version, form),
                                         case_of_paper(version, form, layout), &published_ms));
      }
    }
    add_panel(chart, layout == Layout::aos ? "(a) AoS" : "(b) SoA", std::move(lines));
  }
  return svg_or_nothing(std::move(chart), arrangement);
}

std::string speedup_figure(const ExperimentResult& result, Arrangement arrangement) {
  LogChart chart{"figure-4",
                 "Speedup over the serial CPU version over the number of vertices, in Form A",
                 "vertices",
                 "times faster than the serial CPU version",
                 {}};
  for (const Layout layout : {Layout::soa, Layout::aos}) {
    std::vector<ChartSeries> lines;
    for (const Version version : {Version::cpu, Version::gpu, Version::cdp, Version::resident}) {
      lines.push_back(series_of(result, name_of(version), style_of(version), [&](std::int64_t size) {
        return result.speedup(size, case_of_paper(version, Form::swap, layout));
      }));
    }
    for (const Version version : {Version::gpu, Version::cdp}) {
      LineStyle style = faint_style(version, Form::swap);
      style.dashed = version == Version::cdp;
      lines.push_back(published_series(result, "paper: " + name_of(version), style,
                                       case_of_paper(version, Form::swap, layout), &published_speedup));
    }
    add_panel(chart, layout == Layout::soa ? "(a) SoA, Form A" : "(b) AoS, Form A", std::move(lines));
  }
  return svg_or_nothing(std::move(chart), arrangement);
}

}  // namespace trismooth::experiments

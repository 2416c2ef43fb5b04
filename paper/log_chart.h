// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/pipeline/report/spread.h"

namespace trismooth::experiments {

enum class Marker : std::uint8_t { none, circle, square, diamond, triangle, cross };

/// How a line looks. Marker, filling and dashes tell lines apart where there is no colour.
struct LineStyle {
  std::string_view colour = "#000";  ///< as SVG writes colours
  Marker marker = Marker::circle;
  bool filled = true;   ///< the marker; else it is white inside
  bool dashed = false;  ///< the line
  bool faint = false;   ///< thinner: a line to compare with
};

struct ChartPoint {
  double x = 0;
  Spread y;
};

struct ChartSeries {
  std::string label;
  LineStyle style;
  std::vector<ChartPoint> points;  ///< ascending by x; may be empty
};

struct ChartPanel {
  std::string title;
  std::vector<ChartSeries> series;
};

/// Where panels are: beside each other, for a page or a window as wide, or one below the other, for a narrow one, which
/// has room for labels of forty letters in the legend.
enum class Arrangement : std::uint8_t { row, column };

/// Panels with the same axes, both logarithmic, over one legend. All x and y are positive.
struct LogChart {
  std::string id;           ///< of the element, in a page unique
  std::string description;  ///< for who cannot see it
  std::string x_title;
  std::string y_title;
  std::vector<ChartPanel> panels;  ///< one or more
  Arrangement arrangement = Arrangement::row;
};

/// The chart as one SVG element that needs no style sheet and no font of its own: it may stand in an HTML page or be a
/// file. A point carries its numbers as a tooltip, and a bar from its least to its most. Labels, titles and the
/// description are escaped. The legend names a label once, however many panels have it. Throws std::invalid_argument
/// where no series has a point, or one is not positive.
std::string log_chart_svg(const LogChart& chart);

}  // namespace trismooth::experiments

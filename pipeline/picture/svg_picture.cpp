// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/svg_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/pipeline/picture/base64.h"
#include "trismooth/pipeline/picture/plane_view.h"
#include "trismooth/pipeline/picture/png_text.h"
#include "trismooth/pipeline/picture/still_picture.h"
#include "trismooth/pipeline/report/html_text.h"

namespace trismooth {

namespace {

/// Places in panels are whole numbers of this part of a pixel.
constexpr int svg_units = 10;
constexpr double svg_line_width = 2;
/// Of the edges of elements, as a part of the mean edge, and at most, in pixels.
constexpr double svg_edge_part = 0.05;
constexpr double svg_most_edge = 0.6;

/// A place on the sheet in units.
struct Place {
  std::int64_t x;
  std::int64_t y;
};

Place unit_place(Point2<double> pixel) {
  return {std::llround(pixel.x * svg_units), std::llround(pixel.y * svg_units)};
}

/// The `d` of a path: each line begins where it is as seen from the beginning of the one before.
class PathText {
 public:
  void begin(Place place) {
    text_ += first_ ? 'M' : 'm';
    is_new_ = true;
    add(place.x - start_.x, place.y - start_.y);
    start_ = last_ = place;
    first_ = false;
  }
  void go_to(Place place) {
    if (place.x == last_.x && place.y == last_.y) {
      return;
    }
    // What follows `m` are lines, in the same way of counting; what follows `M` would be absolute.
    if (is_absolute()) {
      text_ += 'l';
      is_new_ = true;
      has_lines_ = true;
    }
    add(place.x - last_.x, place.y - last_.y);
    last_ = place;
  }
  /// Back to where it began.
  void close() {
    text_ += 'z';
    has_lines_ = true;
  }
  /// The next beginning is seen from here.
  void end() {
    start_ = last_;
    has_lines_ = true;
  }
  const std::string& text() const { return text_; }

 private:
  /// Behind the first beginning, which alone is absolute.
  bool is_absolute() const { return !has_lines_; }
  void add(std::int64_t x, std::int64_t y) {
    for (const std::int64_t number : {x, y}) {
      if (!is_new_ && number >= 0) {
        text_ += ' ';
      }
      fmt::format_to(std::back_inserter(text_), "{}", number);
      is_new_ = false;
    }
  }

  std::string text_;
  Place start_{0, 0};
  Place last_{0, 0};
  bool first_ = true;
  bool has_lines_ = false;
  bool is_new_ = false;
};

using Polygon = std::vector<Point2<double>>;

/// The part of a polygon on one side of a line: where inside(point) is not below 0.
template <class Inside>
Polygon half_of(const Polygon& polygon, const Inside& inside) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2<double> from = polygon[i];
    const Point2<double> to = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double a = inside(from);
    const double b = inside(to);
    if (a >= 0) {
      left.push_back(from);
    }
    if ((a >= 0) != (b >= 0)) {
      const double part = a / (a - b);
      left.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
    }
  }
  return left;
}

/// What is far from a panel is cut off, where nobody sees it: viewers have numbers of few digits.
Polygon cut_off(Polygon polygon, const Box& near_panel) {
  const bool is_near = std::ranges::all_of(polygon, [&](Point2<double> point) {
    return point.x >= near_panel.low.x && point.x <= near_panel.high.x && point.y >= near_panel.low.y &&
           point.y <= near_panel.high.y;
  });
  if (!is_near) {
    polygon = half_of(polygon, [&](Point2<double> point) { return point.x - near_panel.low.x; });
    polygon = half_of(polygon, [&](Point2<double> point) { return near_panel.high.x - point.x; });
    polygon = half_of(polygon, [&](Point2<double> point) { return point.y - near_panel.low.y; });
    polygon = half_of(polygon, [&](Point2<double> point) { return near_panel.high.y - point.y; });
  }
  return polygon;
}

/// Draws what a panel shows.
class PanelText {
 public:
  PanelText(const ElementShades& shades, const MeshLines& lines, const SheetPanel& panel)
      : shades_(shades),
        lines_(lines),
        panel_(panel),
        view_(panel.window, panel.width, panel.height),
        screen_{{0, 0}, {static_cast<double>(panel.width), static_cast<double>(panel.height)}},
        near_{{-screen_.high.x, -screen_.high.y}, {2 * screen_.high.x, 2 * screen_.high.y}} {
    for (std::size_t e = 0; e < shades.elements().size(); ++e) {
      if (overlap(pixels_of(e), screen_)) {
        shown_.push_back(e);
      }
    }
  }

  std::size_t elements() const { return shown_.size(); }

  /// All of it; the elements as an image where there are more than `most`.
  std::string text(std::size_t most, int threads) const {
    return fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\">\n{}{}</svg>\n",
                       panel_.corner.x, panel_.corner.y, panel_.width, panel_.height, panel_.width * svg_units,
                       panel_.height * svg_units, shown_.size() > most ? image(threads) : elements_text(),
                       lines_text());
  }

 private:
  Box pixels_of(std::size_t element) const {
    Box box;
    for (const std::int32_t v : shades_.elements()[element]) {
      box.add(view_.pixel(shades_.point(v)));
    }
    return box;
  }

  std::string image(int threads) const {
    StillOptions options;
    options.width = panel_.width;
    options.height = panel_.height;
    options.window = panel_.window;
    options.lines = false;
    options.threads = threads;
    return fmt::format("<image width=\"{}\" height=\"{}\" xlink:href=\"data:image/png;base64,{}\"/>\n",
                       panel_.width * svg_units, panel_.height * svg_units,
                       base64(png_text(draw_still(shades_, nullptr, options))));
  }

  /// A path for each colour, the worst above all others.
  std::string elements_text() const {
    std::array<PathText, ElementShades::inverted + 1> paths;
    double around = 0;
    std::size_t edges = 0;
    for (const std::size_t e : shown_) {
      Polygon corners;
      for (const std::int32_t v : shades_.elements()[e]) {
        corners.push_back(view_.pixel(shades_.point(v)));
      }
      for (std::size_t i = 0; i < corners.size(); ++i) {
        around += std::sqrt(squared_length(corners[i] - corners[i > 0 ? i - 1 : corners.size() - 1]));
      }
      edges += corners.size();
      const Polygon polygon = cut_off(std::move(corners), near_);
      PathText& path = paths[shades_.shade(e)];
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        i == 0 ? path.begin(unit_place(polygon[i])) : path.go_to(unit_place(polygon[i]));
      }
      if (!polygon.empty()) {
        path.close();
      }
    }
    const double width =
        std::min(svg_edge_part * around / static_cast<double>(std::max<std::size_t>(edges, 1)), svg_most_edge);
    std::string text = fmt::format("<g stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linejoin=\"round\">\n",
                                   css_colour(edge_colour), width * svg_units);
    for (std::size_t shade = 0; shade < paths.size(); ++shade) {
      if (!paths[shade].text().empty()) {
        text += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n",
                            css_colour(shades_.colour(static_cast<std::uint8_t>(shade))), paths[shade].text());
      }
    }
    return text + "</g>\n";
  }

  std::string lines_text() const {
    PathText path;
    for (const auto* const edges : {&lines_.boundary, &lines_.interfaces}) {
      for (const auto& [from, to] : *edges) {
        Polygon ends{view_.pixel(shades_.point(from)), view_.pixel(shades_.point(to))};
        Box box;
        box.add(ends[0]);
        box.add(ends[1]);
        if (!overlap(box, screen_)) {
          continue;
        }
        ends = cut_off(std::move(ends), near_);
        if (ends.size() >= 2) {
          path.begin(unit_place(ends[0]));
          path.go_to(unit_place(ends[1]));
          path.end();
        }
      }
    }
    return path.text().empty()
               ? ""
               : fmt::format(
                     "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" d=\"{}\"/>\n",
                     css_colour(line_colour), svg_line_width * svg_units, path.text());
  }

  const ElementShades& shades_;
  const MeshLines& lines_;
  const SheetPanel& panel_;
  PlaneView view_;
  Box screen_;
  Box near_;
  std::vector<std::size_t> shown_;
};

std::string_view anchor_text(TextAnchor anchor) {
  return anchor == TextAnchor::start ? "start" : anchor == TextAnchor::middle ? "middle" : "end";
}

/// A scale is a gradient of its own.
std::string swatch_text(const SheetSwatch& swatch, std::size_t number) {
  std::string fill = css_colour(swatch.colour);
  std::string gradient;
  if (!swatch.stops.empty()) {
    fill = fmt::format("url(#scale{})", number);
    gradient = fmt::format("<linearGradient id=\"scale{}\">", number);
    for (const ColourStop& stop : swatch.stops) {
      gradient += fmt::format(R"(<stop offset="{}" stop-color="{}"/>)", stop.at, css_colour(stop.colour));
    }
    gradient += "</linearGradient>\n";
  }
  return fmt::format("{}<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", gradient,
                     swatch.corner.x, swatch.corner.y, swatch.width, swatch.height, fill);
}

}  // namespace

SvgPicture svg_picture(const ElementShades& shades, const MeshLines& lines, const PictureSheet& sheet, int threads,
                       std::size_t most_elements) {
  SvgPicture picture;
  std::string& text = picture.text;
  text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}\" "
      "height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" font-family=\"sans-serif\" font-size=\"14\" fill=\"{2}\">\n"
      "<title>{3}</title>\n<desc>{4}</desc>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      sheet.width, sheet.height, css_colour(line_colour), escape_html(sheet.title), escape_html(sheet.description));
  for (const SheetPanel& panel : sheet.panels) {
    const PanelText shown(shades, lines, panel);
    if (&panel == &sheet.panels.front() && shown.elements() > most_elements) {
      picture.elements_as_pixels = shown.elements();
    }
    text += shown.text(most_elements, threads);
    text += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"{}\"/>\n",
                        panel.corner.x - 0.5, panel.corner.y - 0.5, panel.width + 1, panel.height + 1,
                        css_colour(frame_colour));
  }
  for (std::size_t i = 0; i < sheet.swatches.size(); ++i) {
    text += swatch_text(sheet.swatches[i], i);
  }
  for (const SheetMark& mark : sheet.marks) {
    for (const auto& [width, colour] : {std::pair{mark_width + 2, Colour{255, 255, 255}}, {mark_width, line_colour}}) {
      text += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
          mark.centre.x, mark.centre.y, mark.radius, css_colour(colour), width);
    }
  }
  // White around the letters first, then the letters: not every program knows the order of strokes.
  for (const std::string_view group :
       {"<g aria-hidden=\"true\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\">\n", "<g>\n"}) {
    text += group;
    for (const SheetText& label : sheet.texts) {
      text += fmt::format(R"(<text x="{:.1f}" y="{:.1f}")", label.at.x, label.at.y);
      if (label.anchor != TextAnchor::start) {
        text += fmt::format(" text-anchor=\"{}\"", anchor_text(label.anchor));
      }
      text += fmt::format(">{}</text>\n", escape_html(label.text));
    }
    text += "</g>\n";
  }
  text += "</svg>\n";
  return picture;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/picture_file.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "trismooth/base/text/digits.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/pipeline/picture/mesh_lines.h"
#include "trismooth/pipeline/picture/picture_sheet.h"
#include "trismooth/pipeline/picture/png_picture.h"
#include "trismooth/pipeline/picture/png_text.h"
#include "trismooth/pipeline/picture/svg_picture.h"
#include "trismooth/pipeline/report/report_format.h"
#include "trismooth/quality/text/report_text.h"

namespace trismooth {

namespace {

/// A mesh that is laid out on a sheet.
struct Drawing {
  const ElementShades& shades;
  const MeshLines& lines;
  const PictureSheet& sheet;
  int threads;
};

PictureFile svg_file(const Drawing& drawing) {
  SvgPicture svg = svg_picture(drawing.shades, drawing.lines, drawing.sheet, drawing.threads);
  if (svg.elements_as_pixels == 0) {
    return {std::move(svg.text), {}};
  }
  return {std::move(svg.text),
          fmt::format("its {} elements are pixels, under lines and letters that are not: an SVG picture has at most {} "
                      "one by one; --picture-window shows a part of the mesh",
                      count_text(static_cast<std::int64_t>(svg.elements_as_pixels)),
                      count_text(static_cast<std::int64_t>(most_elements_of_svg)))};
}

PictureFile png_file(const Drawing& drawing) {
  return {png_text(draw_sheet(drawing.shades, drawing.lines, drawing.sheet, drawing.threads)), {}};
}

using Drawer = PictureFile (*)(const Drawing&);

Drawer drawer_of(const std::filesystem::path& path) {
  static constexpr std::array<ReportFormat<Drawer>, 2> formats{{{".svg", &svg_file}, {".png", &png_file}}};
  return writer_for<Drawer>(path, formats, "picture");
}

/// A box as people name it, where the plane has it: there and back.
template <class Place>
Box box_by(const Place& place, const Box& box) {
  if (!place) {
    return box;
  }
  Box found;
  for (const Point2<double> corner :
       {box.low, box.high, Point2<double>{box.low.x, box.high.y}, Point2<double>{box.high.x, box.low.y}}) {
    found.add(place(corner));
  }
  return found;
}

std::string text_of(const Box& box) {
  constexpr int digits = 6;
  return general_digits(box.low.x, digits) + "," + general_digits(box.low.y, digits) + "," +
         general_digits(box.high.x, digits) + "," + general_digits(box.high.y, digits);
}

}  // namespace

void require_picture_extension(const std::filesystem::path& path) {
  drawer_of(path);
}

Box picture_window(std::string_view text) {
  std::array<double, 4> numbers{};
  std::string_view left = text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t end = i + 1 < numbers.size() ? left.find(',') : left.size();
    const auto number = end != std::string_view::npos ? parse_number<double>(left.substr(0, end)) : std::nullopt;
    if (!number || !std::isfinite(*number)) {
      throw std::invalid_argument(fmt::format("expected four numbers, x0,y0,x1,y1, got '{}'", text));
    }
    numbers[i] = *number;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  const Box window{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
  if (!(window.low.x < window.high.x && window.low.y < window.high.y)) {
    throw std::invalid_argument(
        fmt::format("the window '{}' is empty: it is x0,y0,x1,y1 with x0 below x1 and y0 below y1", text));
  }
  return window;
}

PictureFile picture_file(const std::filesystem::path& path, const MeshPicture& picture,
                         const PictureFileOptions& options) {
  const Drawer draw = drawer_of(path);
  const ElementShades shades(picture, options.value, options.threads);
  const MeshLines lines = mesh_lines(picture, options.threads);
  SheetOptions of_sheet{std::nullopt, options.worst};
  if (options.window) {
    of_sheet.window = box_by(picture.place_shown, *options.window);
  }
  PictureFile file = draw({shades, lines, picture_sheet(shades, of_sheet), options.threads});
  if (of_sheet.window && !has_elements(shades, *of_sheet.window)) {
    file.note = "it is empty: nothing of the mesh is in the window " + text_of(*options.window) + "; the mesh spans " +
                text_of(box_by(picture.shown_place, shades.box()));
  }
  return file;
}

}  // namespace trismooth

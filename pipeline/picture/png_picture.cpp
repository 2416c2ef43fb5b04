// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/png_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "trismooth/pipeline/picture/pixel_letters.h"

namespace trismooth {

namespace {

constexpr Colour paper{255, 255, 255};

std::size_t place_of(const StillPicture& picture, int column, int row) {
  return 3 *
         (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(column));
}

/// What is beyond the rim is left out. `part` of the colour covers what is there.
void cover(StillPicture& picture, int column, int row, Colour colour, double part) {
  if (column < 0 || row < 0 || column >= picture.width || row >= picture.height || !(part > 0)) {
    return;
  }
  std::uint8_t* const pixel = picture.rgb.data() + place_of(picture, column, row);
  const Colour below{pixel[0], pixel[1], pixel[2]};
  const Colour shown = mixed(below, colour, std::min(part, 1.0));
  pixel[0] = shown.red;
  pixel[1] = shown.green;
  pixel[2] = shown.blue;
}

void draw_swatch(StillPicture& picture, const SheetSwatch& swatch) {
  const auto left = static_cast<int>(swatch.corner.x);
  const auto top = static_cast<int>(swatch.corner.y);
  for (int x = 0; x < static_cast<int>(swatch.width); ++x) {
    const Colour colour = swatch.stops.empty() ? swatch.colour : colour_at(swatch.stops, (x + 0.5) / swatch.width);
    for (int y = 0; y < static_cast<int>(swatch.height); ++y) {
      cover(picture, left + x, top + y, colour, 1);
    }
  }
}

void draw_panel(StillPicture& picture, const SheetPanel& panel, const StillPicture& still) {
  const auto left = static_cast<int>(panel.corner.x);
  const auto top = static_cast<int>(panel.corner.y);
  for (int y = 0; y < still.height; ++y) {
    const std::uint8_t* const row = still.rgb.data() + place_of(still, 0, y);
    std::copy_n(row, 3 * still.width, picture.rgb.data() + place_of(picture, left, top + y));
  }
  for (int x = -1; x <= panel.width; ++x) {
    cover(picture, left + x, top - 1, frame_colour, 1);
    cover(picture, left + x, top + panel.height, frame_colour, 1);
  }
  for (int y = 0; y < panel.height; ++y) {
    cover(picture, left - 1, top + y, frame_colour, 1);
    cover(picture, left + panel.width, top + y, frame_colour, 1);
  }
}

void draw_circle(StillPicture& picture, const SheetMark& mark, double width, Colour colour) {
  const double reach = mark.radius + width + 1;
  for (auto y = static_cast<int>(mark.centre.y - reach); y <= mark.centre.y + reach; ++y) {
    for (auto x = static_cast<int>(mark.centre.x - reach); x <= mark.centre.x + reach; ++x) {
      const double distance = std::hypot(x + 0.5 - mark.centre.x, y + 0.5 - mark.centre.y);
      cover(picture, x, y, colour, width / 2 + 0.5 - std::abs(distance - mark.radius));
    }
  }
}

/// With a white rim, on whatever is there.
void draw_label(StillPicture& picture, const SheetText& label) {
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      draw_text(picture, {label.at.x + x, label.at.y + y}, label.anchor, label.text, paper);
    }
  }
  draw_text(picture, label.at, label.anchor, label.text, line_colour);
}

}  // namespace

StillPicture draw_sheet(const ElementShades& shades, const MeshLines& lines, const PictureSheet& sheet, int threads) {
  StillPicture picture{sheet.width, sheet.height, {}};
  picture.rgb.assign(place_of(picture, 0, sheet.height), paper.red);
  for (const SheetPanel& panel : sheet.panels) {
    StillOptions options;
    options.width = panel.width;
    options.height = panel.height;
    options.window = panel.window;
    options.threads = threads;
    draw_panel(picture, panel, draw_still(shades, &lines, options));
  }
  for (const SheetSwatch& swatch : sheet.swatches) {
    draw_swatch(picture, swatch);
  }
  for (const SheetMark& mark : sheet.marks) {
    draw_circle(picture, mark, mark_width + 2, paper);
    draw_circle(picture, mark, mark_width, line_colour);
  }
  for (const SheetText& text : sheet.texts) {
    draw_label(picture, text);
  }
  return picture;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/box.h"
#include "trismooth/pipeline/picture/colours.h"
#include "trismooth/pipeline/picture/element_shades.h"

namespace trismooth {

/// A part of the plane on a sheet; it fills the panel.
struct SheetPanel {
  Point2<double> corner;  ///< left and above
  int width = 0;
  int height = 0;
  Box window;
};

enum class TextAnchor : std::uint8_t { start, middle, end };

/// A line of text, whose base line begins, has its middle or ends at `at`.
struct SheetText {
  Point2<double> at;
  TextAnchor anchor = TextAnchor::start;
  std::string text;
};

/// A rectangle of one colour, or of a scale from left to right.
struct SheetSwatch {
  Point2<double> corner;
  double width = 0;
  double height = 0;
  Colour colour;
  std::span<const ColourStop> stops;  ///< empty: one colour
};

/// A circle around an element, in the main panel and in its close-up.
struct SheetMark {
  Point2<double> centre;
  double radius = 0;
};

/// What is where in a file with a picture, in pixels, y downwards: the main panel, the legend below it, and close-ups
/// below that.
struct PictureSheet {
  int width = 0;
  int height = 0;
  std::string title;  ///< for those who do not see it, as the next one
  std::string description;
  std::vector<SheetPanel> panels;  ///< the main one is the first
  std::vector<SheetText> texts;
  std::vector<SheetSwatch> swatches;
  std::vector<SheetMark> marks;
};

/// What a sheet shows beside the mesh.
struct SheetOptions {
  std::optional<Box> window;  ///< of the plane, in the file's unit; absent: all of the mesh
  int worst = 0;              ///< so many close-ups of the worst elements, of those that are in the window
};

/// How wide the lines of marks are.
inline constexpr double mark_width = 2;

/// How many close-ups there may be.
inline constexpr int most_close_ups = 24;

/// Lays out a picture of a mesh. The worst elements are those by the metric that is shown; by shape, where that is
/// neither good nor bad. Complexity: constant, linear where there are close-ups.
PictureSheet picture_sheet(const ElementShades& shades, const SheetOptions& options);

/// Whether any element is in the window, by the boxes around them. Complexity: linear.
bool has_elements(const ElementShades& shades, const Box& window);

/// The box around an element, in the file's unit.
Box box_of(const ElementShades& shades, std::size_t element);

}  // namespace trismooth

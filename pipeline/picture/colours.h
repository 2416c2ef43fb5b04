// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "trismooth/quality/metrics.h"

namespace trismooth {

/// The colours of all pictures of meshes, in files and in pages. All of them are told apart by those who do not see red
/// from green.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend constexpr bool operator==(const Colour& a, const Colour& b) = default;
};

/// A colour at a place of a scale, from 0 to 1.
struct ColourStop {
  double at;
  Colour colour;
};

/// From the worst element to the best: red to blue.
inline constexpr std::array<ColourStop, 5> quality_colours{{{0.0, {178, 24, 43}},
                                                            {0.5, {239, 138, 98}},
                                                            {0.75, {253, 219, 199}},
                                                            {0.9, {222, 238, 246}},
                                                            {1.0, {146, 197, 222}}}};
/// Of inverted elements, which are below the worst.
inline constexpr Colour inverted_colour{34, 0, 51};
/// Of the edges of elements.
inline constexpr Colour edge_colour{91, 103, 112};
/// Of boundaries and interfaces, and of letters.
inline constexpr Colour line_colour{17, 17, 17};
/// Around pictures.
inline constexpr Colour frame_colour{187, 187, 187};
/// From little to much, of what is neither good nor bad: sizes, distances. (After cividis.)
inline constexpr std::array<ColourStop, 5> amount_colours{{{0.0, {0, 48, 111}},
                                                           {0.25, {75, 92, 124}},
                                                           {0.5, {139, 136, 132}},
                                                           {0.75, {196, 181, 110}},
                                                           {1.0, {255, 234, 70}}}};
/// Of regions, in turn. (After Okabe and Ito.)
inline constexpr std::array<Colour, 8> region_colours{{{86, 180, 233},
                                                       {230, 159, 0},
                                                       {0, 158, 115},
                                                       {204, 121, 167},
                                                       {240, 228, 66},
                                                       {0, 114, 178},
                                                       {213, 94, 0},
                                                       {170, 170, 170}}};

/// The colour at a place of a scale; that of an end outside of it, the first of NaN.
Colour colour_at(std::span<const ColourStop> stops, double place);

/// A colour with `part` of another one above it, from 0 to 1.
Colour mixed(Colour below, Colour above, double part);

/// "#b2182b"
std::string css_colour(Colour colour);

/// Which values of a metric are how good, for elements of one kind: 0 is worst, 1 is ideal.
struct QualityScale {
  double worst = 0;            ///< the value at 0, of a linear scale
  double ideal = 1;            ///< the value at 1
  bool is_reciprocal = false;  ///< the place is ideal / value in place of a linear one

  /// Not above 1; below 0 of inverted elements by the signed metrics, NaN of NaN.
  [[nodiscard]] double place_of(double value) const;
};

/// The scale of a metric. Of area there is none: it is neither good nor bad, and shown by amount_colours. Throws
/// std::invalid_argument for it, and where elements of that kind have none of the metric.
QualityScale quality_scale(Metric metric, ElementKind kind);

}  // namespace trismooth

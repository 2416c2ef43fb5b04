// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/picture_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "trismooth/base/text/digits.h"
#include "trismooth/base/text/printable_text.h"
#include "trismooth/pipeline/picture/plane_view.h"
#include "trismooth/pipeline/picture/still_picture.h"

namespace trismooth {

namespace {

constexpr int sheet_pad = 8;
constexpr int most_width = 1200;
constexpr int most_height = 900;
constexpr int least_side = 40;
constexpr int least_sheet_width = 560;  // room for its legend
constexpr int line_height = 20;         // of text
constexpr int legend_width = 360;
constexpr int legend_height = 14;
constexpr int close_up_side = 288;
constexpr int sheet_gap = 16;
constexpr double mark_radius = 9;

std::string few_digits(double value) {
  constexpr int few = 4;
  return general_digits(value, few);
}

/// A name, without its end where it is long.
std::string shortened(std::string_view name) {
  constexpr std::size_t most = 9;
  constexpr std::size_t left = 6;
  std::string beginning;
  std::string all;
  for (std::size_t i = 0; !name.empty(); ++i) {
    if (i == most) {
      return beginning + "...";
    }
    const TextPiece piece = first_piece(name);
    all += piece.bytes;
    beginning += i < left ? piece.bytes : "";
    name.remove_prefix(piece.bytes.size());
  }
  return all;
}

double value_at(const QualityScale& scale, double place) {
  return scale.is_reciprocal ? scale.ideal / place : scale.worst + place * (scale.ideal - scale.worst);
}

/// What stands at a place of the scale.
std::string label_at(const ElementShades& shades, double place) {
  const PictureValue value = shades.value_shown();
  if (!value.is_quality()) {
    const AmountRange& range = shades.range();
    return few_digits(range.is_logarithmic && range.low > 0 ? range.low * std::pow(range.high / range.low, place)
                                                            : range.low + place * (range.high - range.low));
  }
  std::string label;
  for (const ElementKind kind : {ElementKind::triangle, ElementKind::quadrilateral}) {
    if (const auto* const scale = shades.scale(kind); scale != nullptr && shades.has(kind)) {
      const std::string text = few_digits(value_at(*scale, place));
      label += label.empty() ? text : label == text ? "" : " / " + text;
    }
  }
  return label;
}

/// "min_angle, degrees (triangles / quads)"
std::string legend_title(const ElementShades& shades) {
  const PictureValue value = shades.value_shown();
  std::string title(value.name());
  if (value.kind == ShownKind::moved) {
    return title + ", in the unit of length";
  }
  if (value.kind == ShownKind::region) {
    const std::size_t count = std::max<std::size_t>(shades.picture().region_names.size(), 1);
    return count > region_colours.size()
               ? fmt::format("{}: {} of them, {} colours in turn", title, count, region_colours.size())
               : title;
  }
  if (value.metric == Metric::area) {
    return title + ", on a logarithmic scale";
  }
  const bool has_both = shades.has(ElementKind::triangle) && shades.has(ElementKind::quadrilateral);
  const auto* const of_triangles = shades.scale(ElementKind::triangle);
  const auto* const of_quadrilaterals = shades.scale(ElementKind::quadrilateral);
  const ElementKind kind = of_triangles != nullptr ? ElementKind::triangle : ElementKind::quadrilateral;
  if (const std::string_view unit = info(value.metric, kind).unit; !unit.empty()) {
    title.append(", ").append(unit);
  }
  if (has_both && of_triangles != nullptr && of_quadrilaterals != nullptr &&
      of_triangles->ideal != of_quadrilaterals->ideal) {
    return title + " (triangles / quads)";
  }
  return title + ", worst to best";
}

/// Adds the legend from `top` on. Returns where it ends.
double add_legend(const ElementShades& shades, double top, PictureSheet& sheet) {
  const PictureValue value = shades.value_shown();
  sheet.texts.push_back({{sheet_pad, top + legend_height}, TextAnchor::start, legend_title(shades)});
  top += line_height;
  double x = sheet_pad;
  const auto add_swatch = [&](Colour colour, std::string text) {
    sheet.swatches.push_back({{x, top}, legend_height, legend_height, colour, {}});
    sheet.texts.push_back({{x + line_height, top + legend_height - 2}, TextAnchor::start, std::move(text)});
  };
  if (value.kind == ShownKind::region) {
    constexpr std::size_t in_a_row = 4;
    const auto& names = shades.picture().region_names;
    for (std::size_t i = 0; i < std::min(names.size(), region_colours.size()); ++i) {
      top += i > 0 && i % in_a_row == 0 ? line_height : 0;
      x = sheet_pad + static_cast<double>(i % in_a_row) * (least_sheet_width - 2.0 * sheet_pad) / in_a_row;
      add_swatch(region_colours[i], shortened(names[i]));
    }
    return top + line_height;
  }
  sheet.swatches.push_back({{x, top},
                            legend_width,
                            legend_height,
                            {},
                            value.is_quality() ? std::span<const ColourStop>(quality_colours) : amount_colours});
  constexpr int most_labels = 4;
  constexpr std::size_t longest_label = 5;
  const bool are_short =
      label_at(shades, 0.25).size() <= longest_label && label_at(shades, 0.75).size() <= longest_label;
  const int labels = are_short ? most_labels : most_labels / 2;
  for (int i = 0; i <= labels; ++i) {
    const double place = static_cast<double>(i) / labels;
    sheet.texts.push_back({{x + place * legend_width, top + legend_height + line_height - 4},
                           i == 0        ? TextAnchor::start
                           : i == labels ? TextAnchor::end
                                         : TextAnchor::middle,
                           label_at(shades, place)});
  }
  x += legend_width + sheet_gap;
  if (value.kind == ShownKind::metric) {
    add_swatch(inverted_colour, "inverted");
    for (const ElementKind kind : {ElementKind::triangle, ElementKind::quadrilateral}) {
      if (value.is_quality() && shades.has(kind) && shades.scale(kind) == nullptr) {
        top += line_height;
        add_swatch(lacking_colour,
                   fmt::format("{} have none", kind == ElementKind::triangle ? "triangles" : "quadrilaterals"));
        top -= line_height;
      }
    }
  }
  return top + legend_height + line_height;
}

/// Whether an element reaches into a window. (Of a corner that points inwards both sides are taken.)
bool reaches(const ElementShades& shades, std::size_t element, const Box& window) {
  if (!overlap(box_of(shades, element), window)) {
    return false;
  }
  const auto corners = shades.elements()[element];
  const auto point = [&](std::size_t i) { return shades.point(corners[i % corners.size()]); };
  const std::array<Point2<double>, 4> rim{
      window.low, {window.high.x, window.low.y}, window.high, {window.low.x, window.high.y}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2<double> from = point(i);
    const Point2<double> side = point(i + 1) - from;
    const auto are_on = [&](const auto& places, double sign) {
      return std::ranges::all_of(places, [&](Point2<double> place) { return sign * cross(side, place - from) >= 0; });
    };
    std::vector<Point2<double>> others;
    for (std::size_t k = 2; k < corners.size(); ++k) {
      others.push_back(point(i + k));
    }
    for (const double sign : {1.0, -1.0}) {
      if (squared_length(side) > 0 && are_on(others, sign) && are_on(rim, -sign)) {
        return false;
      }
    }
  }
  return true;
}

/// The worst elements of a window, the worst first, equal ones by their numbers.
std::vector<std::size_t> worst_in(const ElementShades& shades, const Box& window, int count) {
  std::vector<std::pair<double, std::size_t>> worst;
  for (std::size_t e = 0; e < shades.elements().size(); ++e) {
    const std::pair<double, std::size_t> found{shades.place(e), e};
    const bool is_worse = std::ssize(worst) < count || found < worst.back();
    if (!std::isnan(found.first) && is_worse && reaches(shades, e, window)) {
      worst.insert(std::ranges::upper_bound(worst, found), found);
      worst.resize(std::min(worst.size(), static_cast<std::size_t>(count)));
    }
  }
  std::vector<std::size_t> elements;
  for (const auto& [place, element] : worst) {
    elements.push_back(element);
  }
  return elements;
}

/// Half a close-up's width, in extents of its element.
constexpr double around_element = 1.5;

/// A square around an element, with its neighbours.
Box close_up_window(const Box& element) {
  const Point2<double> middle{element.low.x / 2 + element.high.x / 2, element.low.y / 2 + element.high.y / 2};
  const double extent = std::max(element.high.x - element.low.x, element.high.y - element.low.y);
  const double half =
      extent > 0 ? around_element * extent : std::max({std::abs(middle.x), std::abs(middle.y), 1.0}) * 1e-6;
  return {{middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}};
}

/// Adds close-ups from `top` on, and their marks in the main panel. Returns where they end.
double add_close_ups(const ElementShades& shades, int count, double top, PictureSheet& sheet) {
  const SheetPanel main = sheet.panels.front();
  const PlaneView view(main.window, main.width, main.height, main.corner);
  const int columns = std::max((sheet.width - 2 * sheet_pad + sheet_gap) / (close_up_side + sheet_gap), 1);
  const std::vector<std::size_t> worst = worst_in(shades, main.window, count);
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const auto column = static_cast<int>(i) % columns;
    if (column == 0) {
      top += i == 0 ? sheet_pad : close_up_side + 2.0 * line_height + sheet_gap;
    }
    const Box box = box_of(shades, worst[i]);
    const Point2<double> corner{static_cast<double>(sheet_pad + column * (close_up_side + sheet_gap)), top};
    const double below = corner.y + close_up_side + line_height - 2;
    const auto& numbers = shades.picture().numbers;
    const std::int64_t number = numbers.empty() ? static_cast<std::int64_t>(worst[i]) : numbers[worst[i]];
    const std::string which = fmt::format("{}: element {}", i + 1, number);
    const std::string value = fmt::format("{} {}", shades.value_shown().name(), few_digits(shades.value(worst[i])));
    sheet.panels.push_back({corner, close_up_side, close_up_side, close_up_window(box)});
    sheet.texts.push_back({{corner.x, below}, TextAnchor::start, which});
    sheet.texts.push_back({{corner.x, below + line_height}, TextAnchor::start, value});
    sheet.description += fmt::format(" {}, {}.", which, value);
    const Point2<double> mark = view.pixel({box.low.x / 2 + box.high.x / 2, box.low.y / 2 + box.high.y / 2});
    sheet.marks.push_back({mark, mark_radius});
    constexpr double half = close_up_side / 2.0;
    sheet.marks.push_back({{corner.x + half, corner.y + half}, std::numbers::sqrt2 * half / (2 * around_element)});
    // (Beside the circle, on the side where there is more room.)
    const bool is_right = mark.x > main.corner.x + main.width / 2.0;
    sheet.texts.push_back({{mark.x + (is_right ? -mark_radius - 3 : mark_radius + 3), mark.y + 4},
                           is_right ? TextAnchor::end : TextAnchor::start,
                           std::to_string(i + 1)});
  }
  return worst.empty() ? top : top + close_up_side + 2 * line_height;
}

/// As large as it may be, of the window's proportions.
SheetPanel main_panel(const Box& window) {
  const double width = window.high.x / 2 - window.low.x / 2;
  const double height = window.high.y / 2 - window.low.y / 2;
  const auto side = [](double length, double other, int most, int most_other) {
    const double full = length * most_other > other * most ? most : most_other * (length / other);
    return std::clamp(static_cast<int>(std::lround(std::min(full, static_cast<double>(most)))), least_side, most);
  };
  return {{sheet_pad, sheet_pad},
          side(width, height, most_width, most_height),
          side(height, width, most_height, most_width),
          window};
}

}  // namespace

Box box_of(const ElementShades& shades, std::size_t element) {
  Box box;
  for (const std::int32_t v : shades.elements()[element]) {
    box.add(shades.point(v));
  }
  return box;
}

bool has_elements(const ElementShades& shades, const Box& window) {
  for (std::size_t e = 0; e < shades.elements().size(); ++e) {
    if (reaches(shades, e, window)) {
      return true;
    }
  }
  return false;
}

PictureSheet picture_sheet(const ElementShades& shades, const SheetOptions& options) {
  PictureSheet sheet;
  sheet.title = fmt::format("A mesh of {} elements; colour: {}", shades.elements().size(), legend_title(shades));
  sheet.description =
      "Boundaries of the mesh and interfaces of its regions are dark lines, inverted elements nearly black.";
  sheet.panels.push_back(main_panel(options.window.value_or(with_room(shades.box()))));
  const SheetPanel main = sheet.panels.front();
  sheet.width = std::max(main.width, least_sheet_width - 2 * sheet_pad) + 2 * sheet_pad;
  double bottom = add_legend(shades, main.corner.y + main.height + sheet_pad, sheet);
  if (options.worst > 0) {
    if (shades.value_shown().is_quality()) {
      bottom = add_close_ups(shades, options.worst, bottom, sheet);
    } else {
      bottom = add_close_ups(ElementShades(shades.picture(), {}, 1, shades.is_before()), options.worst, bottom, sheet);
    }
  }
  sheet.height = static_cast<int>(bottom) + sheet_pad;
  return sheet;
}

}  // namespace trismooth

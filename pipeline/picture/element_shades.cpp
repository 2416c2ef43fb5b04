// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/element_shades.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/suggestion.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

constexpr std::string_view region_name = "region";
constexpr std::string_view moved_name = "moved";
constexpr std::int64_t looking_grain = 16384;
constexpr int shade_steps = ElementShades::last - ElementShades::first;

template <class Points>
constexpr ElementKind kind_of =
    std::tuple_size_v<std::remove_cvref_t<Points>> == 3 ? ElementKind::triangle : ElementKind::quadrilateral;

double evaluate(Metric metric, const CornerPoints& points) {
  return evaluate(metric, points[0], points[1], points[2]);
}
double evaluate(Metric metric, const QuadrilateralPoints& points) {
  return evaluate(metric, points[0], points[1], points[2], points[3]);
}

bool has_metric(Metric metric, ElementKind kind) {
  return std::ranges::any_of(all_metrics(kind), [metric](const MetricInfo& info) { return info.metric == metric; });
}

/// Which shade has the place of a scale from the worst to the best. (Also of what is no number.)
std::uint8_t shade_at(double place) {
  const double from_best = place > 0 ? 1 - std::min(place, 1.0) : 1.0;
  return static_cast<std::uint8_t>(ElementShades::first + static_cast<int>(std::lround(from_best * shade_steps)));
}

}  // namespace

std::string_view PictureValue::name() const {
  switch (kind) {
    case ShownKind::region:
      return region_name;
    case ShownKind::moved:
      return moved_name;
    case ShownKind::metric:
      break;
  }
  return metrics_of_any_kind()[static_cast<std::size_t>(metric)]->name;
}

PictureValue picture_value_named(std::string_view name) {
  if (name == region_name) {
    return {ShownKind::region};
  }
  if (name == moved_name) {
    return {ShownKind::moved};
  }
  if (const MetricInfo* const found = find_metric(name)) {
    return {ShownKind::metric, found->metric};
  }
  std::string known;
  std::vector<std::string> names;
  for (const MetricInfo* const info : metrics_of_any_kind()) {
    names.emplace_back(info->name);
    known.append(info->name).append(", ");
  }
  names.emplace_back(region_name);
  names.emplace_back(moved_name);
  throw std::invalid_argument("pictures cannot show '" + std::string(name) + "'" + did_you_mean(name, names) +
                              "; they show " + known + "region or moved");
}

ElementShades::ElementShades(const MeshPicture& picture, PictureValue value, int threads, bool before)
    : picture_(picture),
      elements_(picture.elements.list()),
      value_(value),
      is_before_(before),
      points_(before ? picture.before : picture.now()),
      reversed_(before ? picture.reversed_before : picture.reversed_now()) {
  Workers workers(threads);
  look_at_elements(workers);
  frame_ = local_frame(box_.low, box_.high);
  local_.resize(points_.size());
  workers.for_blocks(std::ssize(points_), looking_grain, [this](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      local_[v] = frame_.enter(points_[v]);
    }
  });
  unit_ = frame_.length_scale();
  colours_.fill({255, 255, 255});
  colours_[lacking] = lacking_colour;
  colours_[inverted] = inverted_colour;
  for (int i = 0; i <= shade_steps; ++i) {
    const double part = static_cast<double>(i) / shade_steps;
    colours_[static_cast<std::size_t>(first) + static_cast<std::size_t>(i)] =
        value.is_quality()                ? colour_at(quality_colours, 1 - part)
        : value.kind == ShownKind::region ? region_colours[static_cast<std::size_t>(i) % region_colours.size()]
        : value.kind == ShownKind::moved  ? colour_at(amount_colours, part)
                                          : colour_at(amount_colours, 1 - part);
  }
  if (value.kind == ShownKind::moved) {
    measure_moves();
  } else if (value.kind == ShownKind::metric && value.metric == Metric::area) {
    measure_area();
  } else if (value.kind == ShownKind::metric) {
    bool is_there = elements_.empty();
    for (const ElementKind kind : {ElementKind::triangle, ElementKind::quadrilateral}) {
      if (has_metric(value.metric, kind)) {
        scales_[static_cast<std::size_t>(kind)] = quality_scale(value.metric, kind);
        is_there = is_there || has(kind);
      }
    }
    if (!is_there) {
      const bool are_triangles = has(ElementKind::triangle);
      throw std::invalid_argument("no element of the mesh has " + std::string(value.name()) + ": all are " +
                                  (are_triangles ? "triangles" : "quadrilaterals") + ", which have " +
                                  metric_names(are_triangles ? ElementKind::triangle : ElementKind::quadrilateral));
    }
  }
}

void ElementShades::look_at_elements(Workers& workers) {
  struct Seen {
    Box box;
    std::array<bool, 2> has{};
  };
  const Seen seen = elements_.visit([&]<class Corners>(std::span<const Corners> elements) {
    return joined_blocks(
        std::ssize(elements), looking_grain, workers, Seen{},
        [&](std::int64_t begin, std::int64_t end, Seen& found) {
          for (std::int64_t e = begin; e < end; ++e) {
            const auto corners = static_cast<std::size_t>(corner_count(elements[e]));
            found.has[corners == 3 ? 0 : 1] = true;
            for (std::size_t i = 0; i < corners; ++i) {
              found.box.add(points_[static_cast<std::size_t>(elements[e][i])]);
            }
          }
        },
        [](Seen& all, const Seen& found) {
          all.box.add(found.box);
          all.has = {all.has[0] || found.has[0], all.has[1] || found.has[1]};
        });
  });
  box_ = seen.box;
  has_ = seen.has;
}

void ElementShades::measure_area() {
  range_ = {std::numeric_limits<double>::infinity(), 0, true};
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (const double area = value(e); area > 0) {
      range_.low = std::min(range_.low, area);
      range_.high = std::max(range_.high, area);
    }
  }
  range_.low = std::min(range_.low, range_.high);
}

void ElementShades::measure_moves() {
  if (picture_.after.empty()) {
    throw std::invalid_argument(
        "nothing has moved, so no picture can show how far; smooth, deform and compare make pictures of moved");
  }
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    range_.high = std::max(range_.high, value(e));
  }
}

double ElementShades::amount_place(double value) const {
  if (!(range_.high > range_.low)) {
    return 0;
  }
  return range_.is_logarithmic ? std::log(value / range_.low) / std::log(range_.high / range_.low)
                               : (value - range_.low) / (range_.high - range_.low);
}

template <class Element>
auto ElementShades::points_of_element(std::size_t number, const Element& corners) const {
  const bool is_reversed = !reversed_.empty() && reversed_[number] != 0;
  return points_of(canonical_corners(corners, is_reversed), local_);
}

template <class Element>
double ElementShades::value_of(std::size_t number, const Element& corners) const {
  if (value_.kind == ShownKind::region) {
    return picture_.regions.empty() ? 0 : picture_.regions[number];
  }
  if (value_.kind == ShownKind::moved) {
    double longest = 0;
    for (const std::int32_t v : corners) {
      const auto place = static_cast<std::size_t>(v);
      const Point2<double> move = frame_.enter(picture_.after[place]) - frame_.enter(picture_.before[place]);
      longest = std::max(longest, squared_length(move));
    }
    return std::sqrt(longest) * unit_;
  }
  const auto points = points_of_element(number, corners);
  const double value = evaluate(value_.metric, points);
  return value_.metric == Metric::area ? value * unit_ * unit_ : value;
}

template <class Element>
std::uint8_t ElementShades::shade_of(std::size_t number, const Element& corners) const {
  if (value_.kind == ShownKind::region) {
    const auto region = picture_.regions.empty() ? std::size_t{0} : static_cast<std::size_t>(picture_.regions[number]);
    return static_cast<std::uint8_t>(first + region % region_colours.size());
  }
  if (value_.kind == ShownKind::moved) {
    return static_cast<std::uint8_t>(last + first - shade_at(amount_place(value_of(number, corners))));
  }
  const auto points = points_of_element(number, corners);
  if (shape_quotient(points) < 0) {
    return inverted;
  }
  if (value_.metric == Metric::area) {
    return shade_at(amount_place(evaluate(value_.metric, points) * unit_ * unit_));
  }
  const auto& scale = scales_[static_cast<std::size_t>(kind_of<decltype(points)>)];
  const double value = value_.metric == Metric::shape ? shape(points) : evaluate(value_.metric, points);
  return scale ? shade_at(scale->place_of(value)) : lacking;
}

double ElementShades::value(std::size_t element) const {
  return elements_.visit([&]<class Corners>(std::span<const Corners> elements) {
    return with_kind(elements[element], [&](const auto& corners) { return value_of(element, corners); });
  });
}

double ElementShades::place(std::size_t element) const {
  return elements_.visit([&]<class Corners>(std::span<const Corners> elements) {
    return with_kind(elements[element], [&](const auto& corners) {
      const auto points = points_of_element(element, corners);
      const auto& scale = scales_[static_cast<std::size_t>(kind_of<decltype(points)>)];
      if (!scale) {
        return std::numeric_limits<double>::quiet_NaN();
      }
      const double place = scale->place_of(evaluate(value_.metric, points));
      constexpr double below_all = 2;  // of a metric that is the same for both orientations
      return place >= 0 && shape_quotient(points) < 0 ? place - below_all : place;
    });
  });
}

std::uint8_t ElementShades::shade(std::size_t element) const {
  return elements_.visit([&]<class Corners>(std::span<const Corners> elements) {
    return with_kind(elements[element], [&](const auto& corners) { return shade_of(element, corners); });
  });
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

namespace trismooth {

Colour colour_at(std::span<const ColourStop> stops, double place) {
  std::size_t next = 1;
  while (next + 1 < stops.size() && place > stops[next].at) {
    ++next;
  }
  const ColourStop& low = stops[next - 1];
  const ColourStop& high = stops[next];
  return mixed(low.colour, high.colour, place > low.at ? std::min((place - low.at) / (high.at - low.at), 1.0) : 0.0);
}

Colour mixed(Colour below, Colour above, double part) {
  const auto mix = [part](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + part * (static_cast<double>(to) - from)));
  };
  return {mix(below.red, above.red), mix(below.green, above.green), mix(below.blue, above.blue)};
}

std::string css_colour(Colour colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

double QualityScale::place_of(double value) const {
  return std::min(is_reciprocal ? ideal / value : (value - worst) / (ideal - worst), 1.0);
}

QualityScale quality_scale(Metric metric, ElementKind kind) {
  const double right_angle = kind == ElementKind::triangle ? 60 : 90;
  static_cast<void>(info(metric, kind));  // throws
  switch (metric) {
    case Metric::min_angle:
      return {0, right_angle};
    case Metric::max_angle:
      return {180, right_angle};
    case Metric::aspect_ratio:
    case Metric::radius_ratio:
    case Metric::edge_ratio:
    case Metric::condition:
      return {0, 1, true};
    case Metric::equiangle_skew:
    case Metric::skew:
    case Metric::taper:
      return {1, 0};
    case Metric::area:
      throw std::invalid_argument("area is neither good nor bad");
    case Metric::shape:
    case Metric::scaled_jacobian:
      break;
  }
  return {0, 1};
}

}  // namespace trismooth

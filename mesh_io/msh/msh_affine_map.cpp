// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_affine_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trismooth {

namespace {

using MshVector = std::array<double, 3>;

/// Of what the numbers themselves are rounded to, or a program's own search for a place on a surface.
constexpr double affine_tolerance = 1e-9;

MshVector difference(std::span<const double> points, std::size_t a, std::size_t b) {
  return {points[3 * a] - points[3 * b], points[3 * a + 1] - points[3 * b + 1], points[3 * a + 2] - points[3 * b + 2]};
}
double dot(const MshVector& a, const MshVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const MshVector& a) {
  return std::sqrt(dot(a, a));
}
MshVector scaled(const MshVector& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
/// Without the part along the unit vector.
MshVector without(const MshVector& a, const MshVector& unit) {
  const double part = dot(a, unit);
  return {a[0] - part * unit[0], a[1] - part * unit[1], a[2] - part * unit[2]};
}

}  // namespace

std::optional<MshAffineMap> MshAffineMap::find(std::span<const double> points, std::span<const double> parameters,
                                               std::size_t count) {
  const std::size_t size = points.size() / 3;
  if (size < 2 || count == 0 || count > 2) {
    return std::nullopt;
  }
  // From the first point to the farthest, and from that line to the farthest.
  const auto farthest = [size](const auto& distance) {
    std::size_t found = 0;
    double most = 0;
    for (std::size_t i = 0; i < size; ++i) {
      if (const double reached = distance(i); reached > most) {
        most = reached;
        found = i;
      }
    }
    return std::pair(found, most);
  };
  const auto from_first = [&points](std::size_t i) { return difference(points, i, 0); };
  const auto [end, extent] = farthest([&](std::size_t i) { return length(from_first(i)); });
  if (!(extent > 0) || !std::isfinite(extent)) {
    return std::nullopt;
  }
  const MshVector along = scaled(from_first(end), 1 / extent);
  const auto [side, width] = farthest([&](std::size_t i) { return length(without(from_first(i), along)); });
  const bool is_line = width <= affine_tolerance * extent;
  // On a curve nothing moves beside it; on a surface something may.
  if (is_line != (count == 1)) {
    return std::nullopt;
  }
  const MshVector across = is_line ? MshVector{} : scaled(without(from_first(side), along), 1 / width);
  MshAffineMap map;
  for (std::size_t k = 0; k < count; ++k) {
    const auto value = [&](std::size_t i) { return parameters[count * i + k] - parameters[k]; };
    const double slope = value(end) / extent;
    const double side_slope = is_line ? 0 : (value(side) - slope * dot(from_first(side), along)) / width;
    map.gradients_.push_back({slope * along[0] + side_slope * across[0], slope * along[1] + side_slope * across[1],
                              slope * along[2] + side_slope * across[2]});
    double most = 0;
    double error = 0;
    for (std::size_t i = 0; i < size; ++i) {
      most = std::max(most, std::abs(parameters[count * i + k]));
      const double difference_of_map = std::abs(map.change(from_first(i), k) - value(i));
      if (!(difference_of_map <= std::numeric_limits<double>::max())) {
        return std::nullopt;
      }
      error = std::max(error, difference_of_map);
    }
    if (error > affine_tolerance * most) {
      return std::nullopt;
    }
  }
  return map;
}

double MshAffineMap::change(std::array<double, 3> way, std::size_t parameter) const {
  return dot(way, gradients_[parameter]);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/mesh_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

template <class T>
bool require_finite(const NumberRows<T>& points, std::span<const std::uint8_t> counts) {
  bool all = true;
  for (std::size_t v = 0; v < points.rows; ++v) {
    for (std::size_t k = 0; k < points.columns; ++k) {
      if (!std::isfinite(number_at(points, v, k))) {
        if (counts[v] != 0) {
          throw MeshError("vertex " + std::to_string(v) + " has a coordinate that is not finite");
        }
        all = false;
      }
    }
  }
  return all;
}

template <class T>
std::optional<std::array<int, 2>> exact_axes(const NumberRows<T>& points, std::span<const std::uint8_t> counts) {
  if (points.columns == 2) {
    return std::array{0, 1};
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity};
  std::array<double, 3> high{-infinity, -infinity, -infinity};
  for (std::size_t v = 0; v < points.rows; ++v) {
    if (counts[v] != 0) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto number = static_cast<double>(number_at(points, v, k));
        low[k] = std::min(low[k], number);
        high[k] = std::max(high[k], number);
      }
    }
  }
  const auto half_extent = [&](std::size_t k) { return low[k] <= high[k] ? high[k] / 2 - low[k] / 2 : 0; };
  constexpr std::array<std::pair<std::size_t, std::array<int, 2>>, 3> candidates{
      {{2, {0, 1}}, {1, {0, 2}}, {0, {1, 2}}}};
  const auto* flat = std::ranges::find_if(candidates, [&](const auto& c) { return half_extent(c.first) == 0; });
  return flat == candidates.end() ? std::nullopt : std::optional(flat->second);
}

template <class T>
std::vector<Point2<double>> pairs_of(const NumberRows<T>& points, std::span<const std::uint8_t> counts) {
  std::vector<Point2<double>> pairs(points.rows);
  for (std::size_t v = 0; v < points.rows; ++v) {
    if (counts[v] != 0) {
      pairs[v] = {static_cast<double>(number_at(points, v, 0)), static_cast<double>(number_at(points, v, 1))};
    }
  }
  return pairs;
}

template <class T>
std::vector<double> triples_of(const NumberRows<T>& points) {
  std::vector<double> triples(3 * points.rows);
  for (std::size_t i = 0; i < triples.size(); ++i) {
    triples[i] = static_cast<double>(number_at(points, i / 3, i % 3));
  }
  return triples;
}

InPlane::InPlane(const PlaneFit& fit, std::span<const double> xyz, std::span<const std::uint8_t> counts,
                 Workers& workers)
    : plane(fit.plane) {
  if (!fit.is_planar()) {
    throw MeshError(fit.fault());
  }
  auto projected = project(plane, xyz, counts, workers);
  if (!projected) {
    throw MeshError("the mesh is too large: coordinates along its tilted plane are beyond the range of double");
  }
  points = *std::move(projected);
  local = entered(local_frame(points, [&](std::size_t v) { return counts[v] != 0; }), points);
}

template bool require_finite(const NumberRows<const float>&, std::span<const std::uint8_t>);
template bool require_finite(const NumberRows<const double>&, std::span<const std::uint8_t>);
template std::optional<std::array<int, 2>> exact_axes(const NumberRows<const float>&, std::span<const std::uint8_t>);
template std::optional<std::array<int, 2>> exact_axes(const NumberRows<const double>&, std::span<const std::uint8_t>);
template std::vector<Point2<double>> pairs_of(const NumberRows<const float>&, std::span<const std::uint8_t>);
template std::vector<Point2<double>> pairs_of(const NumberRows<const double>&, std::span<const std::uint8_t>);
template std::vector<double> triples_of(const NumberRows<const float>&);
template std::vector<double> triples_of(const NumberRows<const double>&);

}  // namespace trismooth

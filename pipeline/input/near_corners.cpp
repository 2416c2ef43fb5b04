// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/near_corners.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "trismooth/base/point_squares.h"

namespace trismooth {

std::vector<std::int32_t> join_near_corners(std::span<const Point2<double>> points, const ElementList& elements,
                                            double distance) {
  std::vector<std::int32_t> joined(points.size());
  std::iota(joined.begin(), joined.end(), 0);
  std::vector<std::uint8_t> is_corner(points.size(), 0);
  for (const auto corners : elements) {
    for (const std::int32_t v : corners) {
      is_corner[v] = 1;
    }
  }
  PointSquares squares(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_corner[v] == 0) {
      continue;
    }
    std::int32_t& first = joined[v];
    squares.visit_near(points[v], distance, distance, [&](std::int32_t other) {
      const Point2<double> way = points[other] - points[v];
      if (std::hypot(way.x, way.y) <= distance) {
        first = std::min(first, other);
      }
    });
    if (first == static_cast<std::int32_t>(v)) {
      squares.add(points[v], distance, first);
    }
  }
  return joined;
}

std::int64_t merge_corners(PlanarMesh& mesh, double distance) {
  if (!mesh.quadratics.empty()) {
    throw std::invalid_argument(
        "--merge is for elements of corners alone, and the mesh has some with nodes in the middle of their sides");
  }
  mesh.merged = join_near_corners(mesh.points, mesh.elements, distance);
  mesh.elements.visit([&]<class Corners>(std::span<const Corners> elements) {
    std::vector<Corners> joined(elements.begin(), elements.end());
    for (std::size_t e = 0; e < joined.size(); ++e) {
      const std::span corners(joined[e].begin(), static_cast<std::size_t>(corner_count(joined[e])));
      for (std::int32_t& v : corners) {
        v = mesh.merged[v];
      }
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (std::count(corners.begin(), corners.end(), corners[i]) > 1) {
          const double shortest = shortest_side(mesh.points, mesh.elements);
          throw std::invalid_argument(
              fmt::format("--merge {} would join two corners of the {} in cell {}; {}", distance,
                          corners.size() == 3 ? "triangle" : "quadrilateral", mesh.cells[e],
                          std::isinf(shortest) ? "no side of the mesh has a length"
                                               : fmt::format("the shortest side of the mesh is {:.3g}", shortest)));
        }
      }
    }
    mesh.list(std::move(joined));
  });
  merge_flags(mesh, mesh.in_other_cell);
  std::int64_t joined = 0;
  for (std::size_t v = 0; v < mesh.merged.size(); ++v) {
    joined += mesh.merged[v] != static_cast<std::int32_t>(v) ? 1 : 0;
  }
  return joined;
}

void merge_flags(const PlanarMesh& mesh, std::vector<std::uint8_t>& flags) {
  for (std::size_t v = 0; v < std::min(mesh.merged.size(), flags.size()); ++v) {
    flags[mesh.merged[v]] |= flags[v];
  }
}

void follow_merged(const PlanarMesh& mesh, std::span<const double> before, std::span<double> points) {
  for (std::size_t v = 0; v < mesh.merged.size(); ++v) {
    const std::size_t first = 3 * static_cast<std::size_t>(mesh.merged[v]);
    if (first != 3 * v && !std::equal(before.begin() + static_cast<std::ptrdiff_t>(first),
                                      before.begin() + static_cast<std::ptrdiff_t>(first + 3),
                                      points.begin() + static_cast<std::ptrdiff_t>(first))) {
      std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(first), 3,
                  points.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  }
}

double shortest_side(std::span<const Point2<double>> points, const ElementList& elements) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto corners : elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point2<double> side = points[static_cast<std::size_t>(next_corner(corners, i))] - points[corners[i]];
      const double length = std::hypot(side.x, side.y);
      shortest = length > 0 ? std::min(shortest, length) : shortest;
    }
  }
  return shortest;
}

std::string describe_apart_elements(std::span<const Point2<double>> points, const ElementList& elements) {
  std::string apart = fmt::format("no two of the {} {} share a side, so all vertices are on boundaries",
                                  elements.size(), elements.are_triangles() ? "triangles" : "elements");
  constexpr double near = 0.1;
  const double shortest = shortest_side(points, elements);
  if (std::isinf(shortest)) {
    return apart;
  }
  const std::vector<std::int32_t> joined = join_near_corners(points, elements, near * shortest);
  std::int64_t corners = 0;
  double farthest = 0;
  for (std::size_t v = 0; v < joined.size(); ++v) {
    if (joined[v] != static_cast<std::int32_t>(v)) {
      const Point2<double> way = points[joined[v]] - points[v];
      farthest = std::max(farthest, std::hypot(way.x, way.y));
      ++corners;
    }
  }
  if (corners == 0) {
    return apart;
  }
  constexpr double a_little_more = 1.01;  // than digits that are rounded
  return apart + (farthest == 0
                      ? fmt::format(": {} of their corners lie where others do; --merge 0 joins them", corners)
                      : fmt::format(": {} of their corners nearly coincide with others, within {:.3g}; --merge {:.3g} "
                                    "joins them",
                                    corners, farthest, a_little_more * farthest));
}

}  // namespace trismooth

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

std::vector<std::int32_t> join_near_corners(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                                            double distance) {
  std::vector<std::int32_t> joined(points.size());
  std::iota(joined.begin(), joined.end(), 0);
  std::vector<std::uint8_t> is_corner(points.size(), 0);
  for (const Triangle& triangle : triangles) {
    for (const std::int32_t v : triangle) {
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
    throw std::invalid_argument("--merge is for triangles of three nodes, and the mesh has some of six");
  }
  mesh.merged = join_near_corners(mesh.points, mesh.triangles, distance);
  std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::int32_t& v : triangles[t]) {
      v = mesh.merged[v];
    }
    const auto& [a, b, c] = triangles[t];
    if (a == b || b == c || c == a) {
      throw std::invalid_argument(fmt::format(
          "--merge {} would join two corners of the triangle in cell {}; the shortest side of the mesh is {:.3g}",
          distance, mesh.cells[t], shortest_side(mesh.points, mesh.triangles)));
    }
  }
  mesh.triangles_of_cells = std::move(triangles);
  mesh.triangles = mesh.triangles_of_cells;
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

double shortest_side(std::span<const Point2<double>> points, std::span<const Triangle> triangles) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2<double> side = points[static_cast<std::size_t>(triangle[(i + 1) % 3])] - points[triangle[i]];
      const double length = std::hypot(side.x, side.y);
      shortest = length > 0 ? std::min(shortest, length) : shortest;
    }
  }
  return shortest;
}

std::string describe_apart_triangles(std::span<const Point2<double>> points, std::span<const Triangle> triangles) {
  std::string apart =
      fmt::format("no two of the {} triangles share a side, so all vertices are on boundaries", triangles.size());
  constexpr double near = 0.1;
  const double shortest = shortest_side(points, triangles);
  if (std::isinf(shortest)) {
    return apart;
  }
  const std::vector<std::int32_t> joined = join_near_corners(points, triangles, near * shortest);
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

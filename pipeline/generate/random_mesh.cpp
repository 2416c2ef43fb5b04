// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/random_mesh.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "trismooth/pipeline/generate/delaunay.h"
#include "trismooth/pipeline/generate/mirrored_tiles.h"
#include "trismooth/pipeline/generate/random_points.h"

namespace trismooth {

namespace {

void require_within(const std::string& what, std::int64_t value, std::int64_t lowest, std::int64_t highest) {
  if (value < lowest || value > highest) {
    throw std::invalid_argument(what + ": expected " + std::to_string(lowest) + " to " + std::to_string(highest) +
                                ", got " + std::to_string(value));
  }
}

/// All points random: the mesh of their hull.
RandomMesh hull_of_random_points(std::int64_t vertices, std::mt19937_64& generator) {
  const std::vector<GridPoint> grid_points = random_points(vertices, 0, std::int32_t{1} << grid_bits, generator);
  RandomMesh mesh;
  mesh.points.resize(grid_points.size());
  constexpr double unit = 1.0 / (1 << grid_bits);
  std::transform(grid_points.begin(), grid_points.end(), mesh.points.begin(), [](GridPoint point) {
    return Point2<double>{point[0] * unit, point[1] * unit};
  });
  mesh.triangles = delaunay(grid_points);
  return mesh;
}

/// How many points each side of a tile has beside its corners.
std::int64_t points_per_side(std::int64_t vertices, std::int32_t tiles_per_side, GeneratedBoundary boundary) {
  if (boundary == GeneratedBoundary::random) {
    const double tiles = static_cast<double>(tiles_per_side) * tiles_per_side;
    return std::llround(std::sqrt(static_cast<double>(vertices) / tiles));
  }
  // The edges on a side of the square, as many as in a grid of so many vertices, so that the sides never need more.
  const double edges = std::floor(std::sqrt(static_cast<double>(vertices))) - 1;
  return static_cast<std::int64_t>(edges / tiles_per_side) - 1;
}

RandomMesh tiled(std::int64_t vertices, std::int32_t tiles_per_side, GeneratedBoundary boundary,
                 std::mt19937_64& generator) {
  const double tiles = static_cast<double>(tiles_per_side) * tiles_per_side;
  const std::int64_t on_side = points_per_side(vertices, tiles_per_side, boundary);
  const std::int64_t on_sides = mirrored_vertex_count(0, on_side, tiles_per_side);
  const auto inner_points = std::llround(static_cast<double>(vertices - on_sides) / tiles);
  return mirrored_tiles(random_tile(inner_points, on_side, boundary, generator), tiles_per_side, generator);
}

}  // namespace

RandomMesh random_delaunay_mesh(std::int64_t vertices, std::uint64_t seed, const RandomMeshOptions& options) {
  const auto [boundary, largest_tile] = options;
  require_within("vertices", vertices, least_random_mesh_vertices, max_random_mesh_vertices);
  require_within("vertices of a tile", largest_tile, 256, std::int64_t{1} << 26);
  std::mt19937_64 generator(seed);
  if (boundary == GeneratedBoundary::random && vertices <= largest_tile) {
    return hull_of_random_points(vertices, generator);
  }
  std::int32_t tiles_per_side = 1;
  while (vertices > largest_tile * tiles_per_side * tiles_per_side) {
    tiles_per_side *= 2;
  }
  return tiled(vertices, tiles_per_side, boundary, generator);
}

}  // namespace trismooth

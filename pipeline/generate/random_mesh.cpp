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

RandomMesh single_tile(std::int64_t vertices, std::mt19937_64& generator) {
  const std::vector<GridPoint> grid_points = random_points(vertices, grid_bits, 0, generator);
  RandomMesh mesh;
  mesh.points.resize(grid_points.size());
  constexpr double unit = 1.0 / (1 << grid_bits);
  std::transform(grid_points.begin(), grid_points.end(), mesh.points.begin(), [](GridPoint point) {
    return Point2<double>{point[0] * unit, point[1] * unit};
  });
  mesh.triangles = delaunay(grid_points);
  return mesh;
}

RandomMesh tiled(std::int64_t vertices, std::int32_t tiles_per_side, std::mt19937_64& generator) {
  const double tiles = static_cast<double>(tiles_per_side) * tiles_per_side;
  const auto points_per_side = std::llround(std::sqrt(static_cast<double>(vertices) / tiles));
  const std::int64_t on_sides = mirrored_vertex_count(0, points_per_side, tiles_per_side);
  const auto inner_points = std::llround(static_cast<double>(vertices - on_sides) / tiles);
  return mirrored_tiles(random_tile(inner_points, points_per_side, generator), tiles_per_side, generator);
}

}  // namespace

RandomMesh random_delaunay_mesh(std::int64_t vertices, std::uint64_t seed, std::int64_t largest_tile) {
  require_within("vertices", vertices, 4, max_random_mesh_vertices);
  require_within("vertices of a tile", largest_tile, 256, std::int64_t{1} << 26);
  std::mt19937_64 generator(seed);
  if (vertices <= largest_tile) {
    return single_tile(vertices, generator);
  }
  std::int32_t tiles_per_side = 2;
  while (vertices > largest_tile * tiles_per_side * tiles_per_side) {
    tiles_per_side *= 2;
  }
  return tiled(vertices, tiles_per_side, generator);
}

}  // namespace trismooth

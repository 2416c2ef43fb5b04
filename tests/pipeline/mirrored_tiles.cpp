// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/mirrored_tiles.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "catch.h"

namespace trismooth::mirrored_tiles_test {

using Place = std::pair<double, double>;
using TrianglePlaces = std::array<Place, 3>;

/// The triangles by the places of their corners, each starting at its smallest, so cyclic order is kept.
std::set<TrianglePlaces> places_of(const RandomMesh& mesh) {
  std::set<TrianglePlaces> result;
  for (const auto& triangle : mesh.triangles) {
    TrianglePlaces places;
    std::transform(triangle.begin(), triangle.end(), places.begin(), [&](std::int32_t vertex) {
      return Place{mesh.points[vertex].x, mesh.points[vertex].y};
    });
    std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
    result.insert(places);
  }
  return result;
}

TEST_CASE("four copies of a square cut in two make the square whose diagonals all meet the centre") {
  const SquareTile tile{{{0, 0}, {tile_side, 0}, {tile_side, tile_side}, {0, tile_side}}, 4, {{0, 1, 2}, {0, 2, 3}}};
  std::mt19937_64 generator(1);
  const RandomMesh mesh = mirrored_tiles(tile, 2, generator);
  CHECK(mesh.points.size() == 9);
  const Place centre{0.5, 0.5};
  // Around the centre, counter-clockwise.
  const std::vector<Place> rim{{0, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0.5, 1}, {0, 1}, {0, 0.5}};
  std::set<TrianglePlaces> expected;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    TrianglePlaces places{centre, rim[i], rim[(i + 1) % rim.size()]};
    std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
    expected.insert(places);
  }
  CHECK(places_of(mesh) == expected);
}

TEST_CASE("a mesh of mirrored tiles is its own mirror image") {
  const GeneratedBoundary boundary = GENERATE(GeneratedBoundary::random, GeneratedBoundary::resolved);
  std::mt19937_64 generator(2);
  const RandomMesh mesh = mirrored_tiles(trismooth::random_tile(500, 20, boundary, generator), 4, generator);
  CHECK(static_cast<std::int64_t>(mesh.points.size()) == trismooth::mirrored_vertex_count(500, 20, 4));
  RandomMesh mirrored = mesh;
  for (auto& point : mirrored.points) {
    point.x = 1 - point.x;
  }
  for (auto& triangle : mirrored.triangles) {
    std::swap(triangle[0], triangle[1]);
  }
  CHECK(places_of(mirrored) == places_of(mesh));
}

TEST_CASE("a random tile fills its square, with the points on its sides first") {
  std::mt19937_64 generator(3);
  const std::int64_t inner_points = GENERATE(0, 1, 300);
  const GeneratedBoundary boundary = GENERATE(GeneratedBoundary::random, GeneratedBoundary::resolved);
  const SquareTile tile = trismooth::random_tile(inner_points, 15, boundary, generator);
  REQUIRE(static_cast<std::int64_t>(tile.points.size()) == inner_points + 64);
  REQUIRE(tile.side_points == 64);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(tile.points.size()); ++i) {
    const auto [x, y] = tile.points[i];
    const bool on_side = x == 0 || y == 0 || x == tile_side || y == tile_side;
    CHECK(on_side == (i < tile.side_points));
  }
  std::int64_t area = 0;
  for (const auto& [a, b, c] : tile.triangles) {
    const std::int64_t triangle_area = trismooth::doubled_area(tile.points[a], tile.points[b], tile.points[c]);
    CHECK(triangle_area > 0);
    area += triangle_area;
  }
  CHECK(area == 2 * std::int64_t{tile_side} * tile_side);
}

}  // namespace trismooth::mirrored_tiles_test

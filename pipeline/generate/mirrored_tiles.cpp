// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/mirrored_tiles.h"

#include <cstddef>
#include <set>
#include <utility>

#include "trismooth/pipeline/generate/delaunay.h"
#include "trismooth/pipeline/generate/random_points.h"

namespace trismooth {

namespace {

/// Along one axis: where the tile-relative coordinate `inside` of tile number `tile` comes to lie.
std::int64_t mirrored_coordinate(std::int32_t tile, std::int32_t inside) {
  return tile % 2 == 0 ? std::int64_t{tile_side} * tile + inside : std::int64_t{tile_side} * (tile + 1) - inside;
}

/// Along one axis: the first tile that has the coordinate, `tile` itself or the one before it.
std::int32_t first_tile(std::int32_t tile, std::int32_t inside) {
  const std::int64_t coordinate = mirrored_coordinate(tile, inside);
  return tile > 0 && coordinate == std::int64_t{tile_side} * tile ? tile - 1 : tile;
}

std::set<std::int32_t> random_side(std::int64_t count, std::mt19937_64& generator) {
  std::set<std::int32_t> places;
  while (static_cast<std::int64_t>(places.size()) < count) {
    places.insert(1 + static_cast<std::int32_t>(random_below(tile_side - 1, generator)));
  }
  return places;
}

/// Places that cut a tile's side into parts of one length, to half a unit of the grid.
std::set<std::int32_t> even_side(std::int64_t count) {
  const std::int64_t parts = count + 1;
  std::set<std::int32_t> places;
  for (std::int64_t part = 1; part < parts; ++part) {
    places.insert(static_cast<std::int32_t>((2 * part * tile_side + parts) / (2 * parts)));
  }
  return places;
}

/// The least distance from the sides that the points inside have.
std::int32_t least_distance(std::int64_t points_per_side, GeneratedBoundary boundary) {
  if (boundary == GeneratedBoundary::random) {
    return 1;
  }
  const std::int64_t fifths = 5 * (points_per_side + 1);
  return static_cast<std::int32_t>((tile_side + fifths - 1) / fifths);
}

/// Numbers the vertices of the tiles one tile after the other, row by row; each vertex is new in the first tile that
/// has it.
class TileNumbering {
 public:
  TileNumbering(const SquareTile& tile, std::int32_t tiles_per_side)
      : tile_(tile),
        tiles_per_side_(tiles_per_side),
        side_numbers_(static_cast<std::size_t>(tile.side_points) * tiles_per_side * tiles_per_side) {}

  /// Fills `numbers` with those of the vertices of the next tile, which lies in this column and row.
  void number(std::int32_t column, std::int32_t row, std::vector<std::int32_t>& numbers) {
    numbers.resize(tile_.points.size());
    for (std::int32_t point = 0; point < tile_.side_points; ++point) {
      const auto [x, y] = tile_.points[point];
      const std::int32_t first_column = first_tile(column, x);
      const std::int32_t first_row = first_tile(row, y);
      const bool is_new = first_column == column && first_row == row;
      numbers[point] = is_new ? count_++ : side_number(first_column, first_row, point);
      side_number(column, row, point) = numbers[point];
    }
    for (std::size_t point = tile_.side_points; point < numbers.size(); ++point) {
      numbers[point] = count_++;
    }
  }

 private:
  std::int32_t& side_number(std::int32_t column, std::int32_t row, std::int32_t point) {
    const std::size_t tile_index = static_cast<std::size_t>(row) * tiles_per_side_ + column;
    return side_numbers_[tile_index * tile_.side_points + point];
  }

  const SquareTile& tile_;
  std::int32_t tiles_per_side_;
  std::vector<std::int32_t> side_numbers_;  ///< of the points on the sides of every tile
  std::int32_t count_ = 0;
};

}  // namespace

SquareTile random_tile(std::int64_t inner_points, std::int64_t points_per_side, GeneratedBoundary boundary,
                       std::mt19937_64& generator) {
  SquareTile tile;
  tile.points = {{0, 0}, {tile_side, 0}, {tile_side, tile_side}, {0, tile_side}};
  for (const int axis : {0, 1}) {
    for (const std::int32_t across : {0, tile_side}) {
      for (const std::int32_t along : boundary == GeneratedBoundary::resolved
                                          ? even_side(points_per_side)
                                          : random_side(points_per_side, generator)) {
        tile.points.push_back(axis == 0 ? GridPoint{along, across} : GridPoint{across, along});
      }
    }
  }
  tile.side_points = static_cast<std::int32_t>(tile.points.size());
  const std::int32_t distance = least_distance(points_per_side, boundary);
  const std::vector<GridPoint> inner = random_points(inner_points, distance, tile_side - distance + 1, generator);
  tile.points.insert(tile.points.end(), inner.begin(), inner.end());
  tile.triangles = delaunay(tile.points);
  return tile;
}

std::int64_t mirrored_vertex_count(std::int64_t inner_points, std::int64_t points_per_side,
                                   std::int64_t tiles_per_side) {
  const std::int64_t lines = tiles_per_side + 1;
  return inner_points * tiles_per_side * tiles_per_side + 2 * points_per_side * tiles_per_side * lines + lines * lines;
}

RandomMesh mirrored_tiles(const SquareTile& tile, std::int32_t tiles_per_side, std::mt19937_64& generator) {
  const auto tiles = static_cast<std::int64_t>(tiles_per_side) * tiles_per_side;
  const std::int64_t count = mirrored_vertex_count(static_cast<std::int64_t>(tile.points.size()) - tile.side_points,
                                                   tile.side_points / 4 - 1, tiles_per_side);
  const std::vector<std::int32_t> shuffled = random_permutation(static_cast<std::int32_t>(count), generator);
  const double unit = 1.0 / (static_cast<double>(tile_side) * tiles_per_side);

  RandomMesh mesh;
  mesh.points.resize(static_cast<std::size_t>(count));
  mesh.triangles.reserve(tile.triangles.size() * static_cast<std::size_t>(tiles));
  TileNumbering numbering(tile, tiles_per_side);
  std::vector<std::int32_t> numbers;
  for (std::int32_t row = 0; row < tiles_per_side; ++row) {
    for (std::int32_t column = 0; column < tiles_per_side; ++column) {
      numbering.number(column, row, numbers);
      for (std::size_t point = 0; point < numbers.size(); ++point) {
        numbers[point] = shuffled[numbers[point]];
        const auto [x, y] = tile.points[point];
        mesh.points[numbers[point]] = {static_cast<double>(mirrored_coordinate(column, x)) * unit,
                                       static_cast<double>(mirrored_coordinate(row, y)) * unit};
      }
      const bool reflected = (row + column) % 2 != 0;
      for (auto [a, b, c] : tile.triangles) {
        if (reflected) {
          std::swap(b, c);
        }
        mesh.triangles.push_back({numbers[a], numbers[b], numbers[c]});
      }
    }
  }
  return mesh;
}

}  // namespace trismooth

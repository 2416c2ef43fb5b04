// SPDX-License-Identifier: BSD-3-Clause
#include "tile_blocks.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace tile_blocks {

namespace {

using trismooth::tile_side;

/// Along one axis: where the coordinate `inside` of a tile comes to lie.
std::int64_t mirrored_coordinate(std::int64_t tile, std::int32_t inside) {
  return tile % 2 == 0 ? std::int64_t{tile_side} * tile + inside : std::int64_t{tile_side} * (tile + 1) - inside;
}

/// Along one axis: the first tile that has the coordinate, `tile` itself or the one before it.
std::int64_t first_tile(std::int64_t tile, std::int32_t inside) {
  return tile > 0 && mirrored_coordinate(tile, inside) == std::int64_t{tile_side} * tile ? tile - 1 : tile;
}

/// Numbers the vertices of a block as they are met.
class BlockBuilder {
 public:
  BlockBuilder(const trismooth::SquareTile& tile, TileGrid tiles)
      : tile_(tile),
        tiles_(tiles),
        unit_(1.0 / (static_cast<double>(tile_side) * static_cast<double>(std::max(tiles.columns, tiles.rows)))) {}

  void add(std::int64_t column, std::int64_t row) {
    numbers_.clear();
    for (std::size_t point = 0; point < tile_.points.size(); ++point) {
      numbers_.push_back(number_of(column, row, point));
    }
    const bool reflected = (row + column) % 2 != 0;
    for (auto [a, b, c] : tile_.triangles) {
      if (reflected) {
        std::swap(b, c);
      }
      mesh_.triangles.push_back({numbers_[static_cast<std::size_t>(a)], numbers_[static_cast<std::size_t>(b)],
                                 numbers_[static_cast<std::size_t>(c)]});
    }
  }

  BlockMesh take() { return std::move(mesh_); }

 private:
  std::int32_t number_of(std::int64_t column, std::int64_t row, std::size_t point) {
    const auto [x, y] = tile_.points[point];
    const std::int64_t first_column = first_tile(column, x);
    const std::int64_t first_row = first_tile(row, y);
    const std::int64_t id =
        (first_row * tiles_.columns + first_column) * std::ssize(tile_.points) + static_cast<std::int64_t>(point);
    const auto next = static_cast<std::int32_t>(mesh_.ids.size());
    // Tiles have the points on their sides in common, and no others.
    if (point < static_cast<std::size_t>(tile_.side_points)) {
      if (const auto [place, is_new] = of_sides_.try_emplace(id, next); !is_new) {
        return place->second;
      }
    }
    mesh_.ids.push_back(id);
    mesh_.counts_here.push_back(first_column == column && first_row == row ? 1 : 0);
    mesh_.xy.push_back(static_cast<double>(mirrored_coordinate(column, x)) * unit_);
    mesh_.xy.push_back(static_cast<double>(mirrored_coordinate(row, y)) * unit_);
    return next;
  }

  const trismooth::SquareTile& tile_;
  TileGrid tiles_;
  double unit_;
  std::vector<std::int32_t> numbers_;  ///< of the points of a tile
  std::unordered_map<std::int64_t, std::int32_t> of_sides_;
  BlockMesh mesh_;
};

}  // namespace

TileBlock block_of(int rank, TileGrid ranks, TileGrid tiles) {
  const std::int64_t column = rank % ranks.columns;
  const std::int64_t row = rank / ranks.columns;
  return {{column * tiles.columns / ranks.columns, row * tiles.rows / ranks.rows},
          {(column + 1) * tiles.columns / ranks.columns, (row + 1) * tiles.rows / ranks.rows}};
}

BlockMesh block_mesh(const trismooth::SquareTile& tile, TileGrid tiles, const TileBlock& block) {
  BlockBuilder builder(tile, tiles);
  for (std::int64_t row = block.first[1]; row < block.end[1]; ++row) {
    for (std::int64_t column = block.first[0]; column < block.end[0]; ++column) {
      builder.add(column, row);
    }
  }
  return builder.take();
}

}  // namespace tile_blocks

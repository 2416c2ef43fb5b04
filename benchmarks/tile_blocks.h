// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trismooth/pipeline/generate/mirrored_tiles.h"

/// Meshes of mirrored tiles of which every rank makes its own part alone.
namespace tile_blocks {

/// So many tiles along each axis.
struct TileGrid {
  std::int64_t columns = 1;
  std::int64_t rows = 1;
};

/// Tiles of a grid: columns from first[0] to before end[0], rows likewise.
struct TileBlock {
  std::array<std::int64_t, 2> first{};
  std::array<std::int64_t, 2> end{};
};

/// What a rank has of the mesh.
struct BlockMesh {
  std::vector<std::int64_t> ids;
  std::vector<double> xy;
  std::vector<std::uint8_t> counts_here;  ///< one a vertex: 1 in the first tile that has it, so on one rank of all
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The block of a rank, of the ranks in a grid of their own: as many tiles for each as can be.
TileBlock block_of(int rank, TileGrid ranks, TileGrid tiles);

/// The copies of the tile in a block of the grid, mirrored as mirrored_tiles() does it. Ids are those of the first tile
/// that has the vertex, times the points of a tile, plus the number of the point in it: the same for every cut.
BlockMesh block_mesh(const trismooth::SquareTile& tile, TileGrid tiles, const TileBlock& block);

}  // namespace tile_blocks

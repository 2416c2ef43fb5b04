// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "trismooth/pipeline/generate/grid_predicates.h"
#include "trismooth/pipeline/generate/random_mesh.h"

namespace trismooth {

/// The side of a tile, in units of its grid. A power of two, so that scaling to the unit square is exact; less than
/// the grid's own, so that the far sides lie on the grid as well.
inline constexpr std::int32_t tile_side = 1 << (grid_bits - 1);

/// A mesh that fills the square [0, tile_side]^2, with counter-clockwise triangles.
struct SquareTile {
  std::vector<GridPoint> points;  ///< those on the square's sides come first
  std::int32_t side_points = 0;   ///< how many those are, the four corners included
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The Delaunay mesh of the square's corners, `points_per_side` points on each side and random `inner_points` inside.
/// `boundary` says how the sides' points lie: at random places (then those inside may come near to them), or as
/// GeneratedBoundary::resolved describes.
SquareTile random_tile(std::int64_t inner_points, std::int64_t points_per_side, GeneratedBoundary boundary,
                       std::mt19937_64& generator);

/// The unit square of tiles_per_side x tiles_per_side copies of the tile, mirrored in x in every other column and in y
/// in every other row. Tiles share the vertices on their common sides. Vertices are numbered at random.
/// Precondition: tiles_per_side is a power of two (1 is one), and the result's vertices can be numbered in 32 bits.
RandomMesh mirrored_tiles(const SquareTile& tile, std::int32_t tiles_per_side, std::mt19937_64& generator);

/// Vertices of mirrored_tiles() for a random_tile() of these numbers.
std::int64_t mirrored_vertex_count(std::int64_t inner_points, std::int64_t points_per_side,
                                   std::int64_t tiles_per_side);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/enum_text.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// How the boundary of a generated mesh comes about.
enum class GeneratedBoundary : std::uint8_t {
  random,  ///< all points are random, and the boundary is their hull (the paper's data): some 24 vertices, whose edges
           ///< are up to half as long as the square's side whatever the number of vertices
  resolved,  ///< the square's corners and sides, cut into edges as long as those inside are: about sqrt(n) vertices a
             ///< side. The points inside are not nearer to a side than a fifth of these edges' length
};

template <>
struct EnumText<GeneratedBoundary> {
  static constexpr std::string_view what = "boundary";
  static constexpr std::array<std::pair<GeneratedBoundary, std::string_view>, 2> texts{
      {{GeneratedBoundary::random, "random"}, {GeneratedBoundary::resolved, "resolved"}}};
};

/// A triangle mesh of the unit square. Triangles are counter-clockwise.
struct RandomMesh {
  std::vector<Point2<double>> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The fewest vertices that random_delaunay_mesh() makes.
inline constexpr std::int64_t least_random_mesh_vertices = 4;

/// The most vertices that random_delaunay_mesh() makes. Each takes about six directed edges, which 32 bits must number.
inline constexpr std::int64_t max_random_mesh_vertices = (std::int64_t{1} << 31) / 7;

/// What random_delaunay_mesh() may be asked for.
struct RandomMeshOptions {
  GeneratedBoundary boundary = GeneratedBoundary::random;
  std::int64_t largest_tile = 1 << 22;  ///< the most vertices of a tile, 256 to 2^26
};

/// The Delaunay mesh of about `vertices` points, uniformly random in the unit square and in random order. It depends on
/// the arguments alone, not on platform, library or time. Coordinates are exact multiples of a power of two (where
/// there is one tile 2^-30, or 2^-29 where its boundary is resolved), and no two vertices coincide.
///
/// Up to `largest_tile` vertices there are exactly as many as asked for. The mesh fills their convex hull, which is the
/// unit square where the boundary is resolved: of n vertices, 4 (floor(sqrt(n)) - 1) lie on it, at one distance to half
/// a unit of 2^-29.
///
/// A larger mesh is a square of 2^k x 2^k tiles, all copies of one that is mirrored from column to column and from row
/// to row, so that sides match; it fills the unit square exactly. The tile is the Delaunay mesh of n random points of
/// which about sqrt(n) lie on each of its sides: at random places, or, where the boundary is resolved, as on the
/// boundary. Then the lines between tiles, too, have vertices at one distance and none close by, which are free to move
/// as all inside are. The triangles on both sides of such a line need not be Delaunay to each other. The number of
/// vertices is the nearest to `vertices` that tiles give, at most 4^k / 2 off.
///
/// Throws std::invalid_argument where `vertices` is below least_random_mesh_vertices or above max_random_mesh_vertices,
/// or options.largest_tile is out of its range. Complexity: O(n log n) for the n vertices of the tile, and O(vertices).
RandomMesh random_delaunay_mesh(std::int64_t vertices, std::uint64_t seed, const RandomMeshOptions& options = {});

/// The mesh as the library takes it: two coordinates a vertex, three indices a triangle. Views of `mesh`.
inline std::span<const double> flat_points(const RandomMesh& mesh) {
  static_assert(sizeof(Point2<double>) == 2 * sizeof(double));
  return {&mesh.points.front().x, 2 * mesh.points.size()};
}
inline std::span<const std::int32_t> flat_triangles(const RandomMesh& mesh) {
  return {mesh.triangles.front().data(), 3 * mesh.triangles.size()};
}

}  // namespace trismooth

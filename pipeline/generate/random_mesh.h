#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"

namespace trismooth {

/// A triangle mesh of the unit square. Triangles are counter-clockwise.
struct RandomMesh {
  std::vector<Point2<double>> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The fewest vertices that random_delaunay_mesh() makes.
inline constexpr std::int64_t least_random_mesh_vertices = 4;

/// The most vertices that random_delaunay_mesh() makes. Each takes about six directed edges, which 32 bits must number.
inline constexpr std::int64_t max_random_mesh_vertices = (std::int64_t{1} << 31) / 7;

/// The Delaunay mesh of about `vertices` points, uniformly random in the unit square and in random order. It depends on
/// the arguments alone, not on platform, library or time. Coordinates are exact multiples of a power of two (2^-30
/// where there is one tile), and no two vertices coincide.
///
/// Up to `largest_tile` vertices there are exactly as many as asked for, and the mesh fills their convex hull.
/// A larger mesh is a square of 2^k x 2^k tiles, all copies of one that is mirrored from column to column and from row
/// to row, so that sides match; it fills the unit square exactly. The tile is the Delaunay mesh of n random points of
/// which about sqrt(n) lie on each of its sides. The triangles on both sides of a line between tiles need not be
/// Delaunay to each other. The number of vertices is the nearest to `vertices` that tiles give, at most 4^k / 2 off.
///
/// Throws std::invalid_argument where `vertices` is below least_random_mesh_vertices or above max_random_mesh_vertices,
/// or `largest_tile` is below 256 or above 2^26. Complexity: O(n log n) for the n vertices of the tile, and
/// O(vertices).
RandomMesh random_delaunay_mesh(std::int64_t vertices, std::uint64_t seed, std::int64_t largest_tile = 1 << 22);

/// The mesh as the library takes it: two coordinates a vertex, three indices a triangle. Views of `mesh`.
inline std::span<const double> flat_points(const RandomMesh& mesh) {
  static_assert(sizeof(Point2<double>) == 2 * sizeof(double));
  return {&mesh.points.front().x, 2 * mesh.points.size()};
}
inline std::span<const std::int32_t> flat_triangles(const RandomMesh& mesh) {
  return {mesh.triangles.front().data(), 3 * mesh.triangles.size()};
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/constraints.h"

#include "support/test_meshes.h"

/// Valid meshes of domains of many shapes, and what tangles them: for who untangles.
namespace tangled_meshes {

using test_meshes::Mesh;

/// What a mesh fills.
enum class Domain : std::uint8_t {
  square,     ///< the unit square, its sides as finely divided as the inside
  disc,       ///< a disc, likewise
  hull,       ///< the convex hull of random points: a few long edges
  graded,     ///< a square whose elements grow from one corner on, the largest some hundred times the smallest
  flat,       ///< a rectangle fifty times as long as high, with as many elements along each side: all are flat
  corner,     ///< an L
  comb,       ///< teeth on a bar
  holes,      ///< a square with round holes
  ring,       ///< what is between two circles
  flat_comb,  ///< a comb, ten times as long as high, elements likewise
  regions,    ///< a square of several regions: their boundaries are held
  twisted,    ///< a ring whose inner circle has been turned, elements with it
  wave,       ///< a square whose columns have been moved up and down, elements with them
  spiral,     ///< a band along a spiral
};
inline constexpr std::array all_domains{
    Domain::square, Domain::disc, Domain::hull,      Domain::graded,  Domain::flat,    Domain::corner, Domain::comb,
    Domain::holes,  Domain::ring, Domain::flat_comb, Domain::regions, Domain::twisted, Domain::wave,   Domain::spiral};
std::string_view name_of(Domain domain);

/// A mesh in which every triangle is valid, and what is held of it beside the boundary.
struct ValidMesh {
  Mesh mesh;
  std::vector<std::int32_t> regions;
  std::vector<std::uint8_t> fixed;  ///< per vertex: whether anything holds it

  trismooth::Constraints constraints() const { return {{}, {}, {}, regions}; }
};

/// About `vertices` random vertices, at least 16, in random order.
ValidMesh valid_mesh(Domain domain, std::int32_t vertices, std::uint64_t seed);

/// The mesh with every triangle cut in three quadrilaterals, from its middle to those of its sides.
struct CutMesh {
  ValidMesh in_triangles;  ///< with each quadrilateral as two triangles, of the same vertices
  std::vector<trismooth::MixedElement> quadrilaterals;
  std::vector<trismooth::MixedElement> both;  ///< every second quadrilateral is two triangles
};
CutMesh cut_in_quadrilaterals(const ValidMesh& mesh);

/// What is done to the free vertices of a mesh.
enum class Tangle : std::uint8_t {
  some_displaced,  ///< 3 % of them (one at least) are displaced by up to three of their edges
  many_displaced,  ///< 30 % of them
  all_displaced,   ///< all of them
  one_point,       ///< all are at one point, the middle of the bounding box
  anywhere,        ///< all are at random places in the bounding box
};
inline constexpr std::array all_tangles{Tangle::some_displaced, Tangle::many_displaced, Tangle::all_displaced,
                                        Tangle::one_point, Tangle::anywhere};
std::string_view name_of(Tangle tangle);

/// The mesh's points, tangled.
std::vector<test_meshes::Point> tangled_points(const ValidMesh& mesh, Tangle tangle, std::uint64_t seed);

/// `part` of the free vertices (in [0, 1]) displaced by up to `edges` times the mean length of their edges.
std::vector<test_meshes::Point> displaced_points(const ValidMesh& mesh, double part, double edges, std::uint64_t seed);

/// Holds the neighbours of about `count` vertices and puts one neighbour of each across the others: some triangles
/// around these vertices are inverted wherever free vertices are. Changes mesh.fixed, and the points of the held ones.
void fold_by_held_vertices(ValidMesh& mesh, std::int32_t count, std::uint64_t seed);

}  // namespace tangled_meshes

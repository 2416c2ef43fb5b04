// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

class Workers;

/// The components of a mesh: triangles connected through edges with exactly two triangles, which are not two of the
/// same three corners: a triangle that is listed again lies upon the other and is no neighbour of it.
struct TriangleComponents {
  std::vector<std::uint8_t> parity;    ///< per triangle: 1 where it is listed against its component's lowest triangle
  BulkVector<std::int32_t> component;  ///< per triangle: from 0, in the order of their lowest triangles
  std::int32_t components = 0;
  bool alike = false;  ///< no triangle is listed against its component's lowest one; false says nothing
};

/// The sides of triangles, matched where they are the same edge: what a topology is built from, TriangleTopology as
/// well as a halfedge mesh. Halfedge 3 t + i runs from corner i of triangle t, as listed, to the next corner.
struct MatchedSides : TriangleComponents {
  static constexpr std::int32_t no_twin = -1;  ///< a boundary edge
  static constexpr std::int32_t many_twins =
      -2;  ///< an edge with three triangles or more, or with two of the same corners

  std::int32_t vertex_count = 0;
  BulkVector<std::int32_t> twins;   ///< per halfedge: the other triangle's halfedge on the edge
  BulkVector<std::int32_t> corner;  ///< per vertex: the lowest halfedge that starts there; -1: isolated
  std::vector<std::uint8_t> hold;   ///< per vertex: bits boundary, non_manifold, isolated
};

/// How the triangles of flat arrays hang together. `hold` has the bit bow_tie as well.
struct TriangleTopology : MatchedSides {
  BulkVector<std::int32_t> degree;  ///< per vertex: its triangles
};

/// Where check_triangles() would throw.
inline bool is_faulty(std::int32_t vertex_count, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const auto is_vertex = [vertex_count](std::int32_t v) {
    return static_cast<std::uint32_t>(v) < static_cast<std::uint32_t>(vertex_count);
  };
  return !is_vertex(a) || !is_vertex(b) || !is_vertex(c) || a == b || b == c || c == a;
}

/// Throws MeshError for an index that is not of a vertex 0 .. vertex_count - 1 and a triangle that repeats a vertex.
void check_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles);

/// Matches the sides of triangles over vertices 0 .. vertex_count - 1. Throws MeshError for a negative count, an index
/// out of range, a triangle that repeats a vertex and a component that cannot be oriented (a Moebius band). Complexity:
/// linear.
///
/// `ghosts`: one flag a vertex, where the triangles are a part of a mesh that has all those of vertices without it, and
/// maybe not all of the others. What is said of ghosts means nothing then, and triangles are not taken for connected
/// through an edge between two of them.
MatchedSides match_sides(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                         std::span<const std::uint8_t> ghosts = {});

/// Connects the triangles around each vertex as well. Arguments, errors and complexity are those of match_sides().
TriangleTopology connect_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                                   std::span<const std::uint8_t> ghosts = {});

/// The corner of the same vertex on the other side of the halfedge `across` of the corner's triangle, or a negative
/// value where there is none. A corner is named by the halfedge that starts there.
inline std::int32_t corner_across(const MatchedSides& topology, std::span<const Triangle> triangles,
                                  std::int32_t vertex, std::int32_t across) {
  const std::int32_t twin = topology.twins[across];
  if (twin < 0) {
    return twin;
  }
  const std::int32_t triangle = twin / 3;
  const std::int32_t i = twin % 3;
  return triangles[triangle][i] == vertex ? twin : 3 * triangle + (i + 1) % 3;
}

/// The corner after `corner` around its vertex, counter-clockwise in the orientation `reversed` (either `parity` or
/// Orientation::reversed), or a negative value at the end of an open fan.
inline std::int32_t next_corner(const MatchedSides& topology, std::span<const Triangle> triangles,
                                std::span<const std::uint8_t> reversed, std::int32_t corner) {
  const std::int32_t t = corner / 3;
  const std::int32_t i = corner % 3;
  return corner_across(topology, triangles, triangles[t][i], reversed[t] != 0 ? corner : 3 * t + (i + 2) % 3);
}

/// The corner before `corner` around its vertex: next_corner(), clockwise.
inline std::int32_t previous_corner(const MatchedSides& topology, std::span<const Triangle> triangles,
                                    std::span<const std::uint8_t> reversed, std::int32_t corner) {
  const std::int32_t t = corner / 3;
  const std::int32_t i = corner % 3;
  return corner_across(topology, triangles, triangles[t][i], reversed[t] != 0 ? 3 * t + (i + 2) % 3 : corner);
}

/// The neighbour with which the corner's triangle begins, counter-clockwise around the corner's vertex.
inline std::int32_t leading_neighbour(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                                      std::int32_t corner) {
  const std::int32_t triangle = corner / 3;
  return triangles[triangle][(corner % 3 + (reversed[triangle] != 0 ? 2 : 1)) % 3];
}

/// Steps between the corners around a vertex, in the orientation `reversed`: see next_corner().
struct CornersAround {
  const MatchedSides& sides;
  std::span<const Triangle> triangles;
  std::span<const std::uint8_t> reversed;

  std::int32_t after(std::int32_t corner) const { return next_corner(sides, triangles, reversed, corner); }
  std::int32_t before(std::int32_t corner) const { return previous_corner(sides, triangles, reversed, corner); }
  std::int32_t leading(std::int32_t corner) const { return leading_neighbour(triangles, reversed, corner); }
};

/// What CornersAround answers, where no triangle is reversed, or all are: the twin of a side runs the other way.
template <bool Reversed>
struct AlikeCorners {
  const MatchedSides& sides;
  std::span<const Triangle> triangles;

  std::int32_t after(std::int32_t corner) const { return Reversed ? behind_twin(corner) : twin_before(corner); }
  std::int32_t before(std::int32_t corner) const { return Reversed ? twin_before(corner) : behind_twin(corner); }
  std::int32_t leading(std::int32_t corner) const {
    const std::int32_t i = corner % 3;
    return triangles[corner / 3][Reversed ? (i == 0 ? 2 : i - 1) : (i == 2 ? 0 : i + 1)];
  }

 private:
  std::int32_t twin_before(std::int32_t corner) const { return sides.twins[corner % 3 == 0 ? corner + 2 : corner - 1]; }
  std::int32_t behind_twin(std::int32_t corner) const {
    const std::int32_t twin = sides.twins[corner];
    return twin < 0 ? twin : twin % 3 == 2 ? twin - 2 : twin + 1;
  }
};

/// Whether all flags are 0, and whether none is.
struct Uniform {
  bool zeros;
  bool ones;
};
Uniform uniform(std::span<const std::uint8_t> flags, Workers& workers);

/// Calls body(corners) with what steps between the corners of the mesh in the orientation `reversed`: AlikeCorners
/// where they do, since they take half of the time, else CornersAround.
template <class Body>
void with_corners(const MatchedSides& sides, std::span<const Triangle> triangles,
                  std::span<const std::uint8_t> reversed, Workers& workers, const Body& body) {
  const Uniform flags = sides.alike ? uniform(reversed, workers) : Uniform{false, false};
  if (flags.zeros) {
    body(AlikeCorners<false>{sides, triangles});
  } else if (flags.ones) {
    body(AlikeCorners<true>{sides, triangles});
  } else {
    body(CornersAround{sides, triangles, reversed});
  }
}

}  // namespace trismooth

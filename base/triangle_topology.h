// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ranges>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

class Workers;

/// Here elements are triangles (Triangle), or triangles and quadrilaterals (MixedElement); what is said of an array of
/// elements, `Elements`, holds for one of either.

/// The components of a mesh: elements connected through edges with exactly two elements, which are not two of the same
/// corners: an element that is listed again lies upon the other and is no neighbour of it.
struct TriangleComponents {
  std::vector<std::uint8_t> parity;    ///< per element: 1 where it is listed against its component's lowest element
  BulkVector<std::int32_t> component;  ///< per element: from 0, in the order of their lowest elements
  std::int32_t components = 0;
  bool alike = false;  ///< no element is listed against its component's lowest one; false says nothing
};

/// The sides of elements, matched where they are the same edge: what a topology is built from, TriangleTopology as
/// well as a halfedge mesh. Halfedge 3 t + i runs from corner i of triangle t, as listed, to the next corner; 4 t + i
/// where quadrilaterals are among the elements.
struct MatchedSides : TriangleComponents {
  static constexpr std::int32_t no_twin = -1;  ///< a boundary edge; the fourth side of a triangle
  static constexpr std::int32_t many_twins =
      -2;  ///< an edge with three elements or more, or with two of the same corners

  std::int32_t vertex_count = 0;
  BulkVector<std::int32_t> twins;   ///< per halfedge: the other element's halfedge on the edge
  BulkVector<std::int32_t> corner;  ///< per vertex: the lowest halfedge that starts there; -1: isolated
  std::vector<std::uint8_t> hold;   ///< per vertex: bits boundary, non_manifold, isolated
};

/// How the elements of flat arrays hang together. `hold` has the bit bow_tie as well.
struct TriangleTopology : MatchedSides {
  BulkVector<std::int32_t> degree;  ///< per vertex: its elements
};

/// Where check_triangles() would throw.
inline bool is_faulty(std::int32_t vertex_count, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const auto is_vertex = [vertex_count](std::int32_t v) {
    return static_cast<std::uint32_t>(v) < static_cast<std::uint32_t>(vertex_count);
  };
  return !is_vertex(a) || !is_vertex(b) || !is_vertex(c) || a == b || b == c || c == a;
}
inline bool is_faulty(std::int32_t vertex_count, const MixedElement& element) {
  const auto& [a, b, c, d] = element;
  return is_faulty(vertex_count, Triangle{a, b, c}) ||
         (d != no_corner && (is_faulty(vertex_count, Triangle{a, c, d}) || d == b));
}

/// Throws MeshError for an index that is not of a vertex 0 .. vertex_count - 1 and an element that repeats a vertex.
void check_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles);
void check_triangles(std::int32_t vertex_count, std::span<const MixedElement> elements);

/// Matches the sides of elements over vertices 0 .. vertex_count - 1. Throws MeshError for a negative count, an index
/// out of range, an element that repeats a vertex and a component that cannot be oriented (a Moebius band). Complexity:
/// linear.
///
/// `ghosts`: one flag a vertex, where the elements are a part of a mesh that has all those of vertices without it, and
/// maybe not all of the others. What is said of ghosts means nothing then, and elements are not taken for connected
/// through an edge between two of them.
MatchedSides match_sides(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                         std::span<const std::uint8_t> ghosts = {});
MatchedSides match_sides(std::int32_t vertex_count, std::span<const MixedElement> elements, Workers& workers,
                         std::span<const std::uint8_t> ghosts = {});

/// Connects the elements around each vertex as well. Arguments, errors and complexity are those of match_sides().
TriangleTopology connect_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                                   std::span<const std::uint8_t> ghosts = {});
TriangleTopology connect_triangles(std::int32_t vertex_count, std::span<const MixedElement> elements, Workers& workers,
                                   std::span<const std::uint8_t> ghosts = {});

/// How many halfedges an element has, those of a quadrilateral where these are among the elements.
template <class Elements>
inline constexpr std::int32_t sides_of = std::tuple_size_v<std::ranges::range_value_t<Elements>>;

/// The element of a halfedge, and its corner there.
template <class Elements>
constexpr std::int32_t element_of_halfedge(std::int32_t halfedge) {
  return halfedge / sides_of<Elements>;
}
template <class Elements>
constexpr std::int32_t corner_of_halfedge(std::int32_t halfedge) {
  return halfedge % sides_of<Elements>;
}

/// The vertex where the halfedge begins.
template <class Elements>
std::int32_t start_of(const Elements& elements, std::int32_t halfedge) {
  return elements[element_of_halfedge<Elements>(halfedge)][corner_of_halfedge<Elements>(halfedge)];
}
/// The halfedge behind that one, as its element is listed.
template <class Elements>
std::int32_t halfedge_after(const Elements& elements, std::int32_t halfedge) {
  const std::int32_t last = corner_count(elements[element_of_halfedge<Elements>(halfedge)]) - 1;
  return corner_of_halfedge<Elements>(halfedge) == last ? halfedge - last : halfedge + 1;
}
/// The halfedge in front of that one, as its element is listed.
template <class Elements>
std::int32_t halfedge_before(const Elements& elements, std::int32_t halfedge) {
  const std::int32_t last = corner_count(elements[element_of_halfedge<Elements>(halfedge)]) - 1;
  return corner_of_halfedge<Elements>(halfedge) == 0 ? halfedge + last : halfedge - 1;
}

/// The corner of the same vertex on the other side of the halfedge `across` of the corner's element, or a negative
/// value where there is none. A corner is named by the halfedge that starts there.
template <class Elements>
std::int32_t corner_across(const MatchedSides& topology, const Elements& elements, std::int32_t vertex,
                           std::int32_t across) {
  const std::int32_t twin = topology.twins[across];
  return twin < 0 || start_of(elements, twin) == vertex ? twin : halfedge_after(elements, twin);
}

/// The corner after `corner` around its vertex, counter-clockwise in the orientation `reversed` (either `parity` or
/// Orientation::reversed), or a negative value at the end of an open fan.
template <class Elements>
std::int32_t next_corner(const MatchedSides& topology, const Elements& elements, std::span<const std::uint8_t> reversed,
                         std::int32_t corner) {
  const bool is_reversed = reversed[element_of_halfedge<Elements>(corner)] != 0;
  return corner_across(topology, elements, start_of(elements, corner),
                       is_reversed ? corner : halfedge_before(elements, corner));
}

/// The corner before `corner` around its vertex: next_corner(), clockwise.
template <class Elements>
std::int32_t previous_corner(const MatchedSides& topology, const Elements& elements,
                             std::span<const std::uint8_t> reversed, std::int32_t corner) {
  const bool is_reversed = reversed[element_of_halfedge<Elements>(corner)] != 0;
  return corner_across(topology, elements, start_of(elements, corner),
                       is_reversed ? halfedge_before(elements, corner) : corner);
}

/// The neighbour with which the corner's element begins, counter-clockwise around the corner's vertex.
template <class Elements>
std::int32_t leading_neighbour(const Elements& elements, std::span<const std::uint8_t> reversed, std::int32_t corner) {
  const bool is_reversed = reversed[element_of_halfedge<Elements>(corner)] != 0;
  return start_of(elements, is_reversed ? halfedge_before(elements, corner) : halfedge_after(elements, corner));
}

/// Steps between the corners around a vertex, in the orientation `reversed`: see next_corner().
template <class Elements>
struct CornersAround {
  const MatchedSides& sides;
  Elements elements;
  std::span<const std::uint8_t> reversed;

  std::int32_t after(std::int32_t corner) const { return next_corner(sides, elements, reversed, corner); }
  std::int32_t before(std::int32_t corner) const { return previous_corner(sides, elements, reversed, corner); }
  std::int32_t leading(std::int32_t corner) const { return leading_neighbour(elements, reversed, corner); }
};

/// What CornersAround answers, where no element is reversed, or all are: the twin of a side runs the other way.
template <bool Reversed, class Elements>
struct AlikeCorners {
  const MatchedSides& sides;
  Elements elements;

  std::int32_t after(std::int32_t corner) const { return Reversed ? behind_twin(corner) : twin_before(corner); }
  std::int32_t before(std::int32_t corner) const { return Reversed ? twin_before(corner) : behind_twin(corner); }
  std::int32_t leading(std::int32_t corner) const {
    return start_of(elements, Reversed ? halfedge_before(elements, corner) : halfedge_after(elements, corner));
  }

 private:
  std::int32_t twin_before(std::int32_t corner) const { return sides.twins[halfedge_before(elements, corner)]; }
  std::int32_t behind_twin(std::int32_t corner) const {
    const std::int32_t twin = sides.twins[corner];
    return twin < 0 ? twin : halfedge_after(elements, twin);
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
template <class Corners, class Body>
void with_corners(const MatchedSides& sides, std::span<const Corners> elements, std::span<const std::uint8_t> reversed,
                  Workers& workers, const Body& body) {
  using Elements = std::span<const Corners>;
  const Uniform flags = sides.alike ? uniform(reversed, workers) : Uniform{false, false};
  if (flags.zeros) {
    body(AlikeCorners<false, Elements>{sides, elements});
  } else if (flags.ones) {
    body(AlikeCorners<true, Elements>{sides, elements});
  } else {
    body(CornersAround<Elements>{sides, elements, reversed});
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/triangle_topology.h"

namespace trismooth {

struct ListedRings;

/// The numbers of a ring with quadrilaterals: a MixedRing (see ring_elements.h).
struct MixedRingNumbers {
  std::span<const std::int32_t> neighbours;
  std::span<const std::int32_t> opposites;  ///< one a neighbour, see OneRings

  int size() const { return static_cast<int>(neighbours.size()); }
  std::int32_t operator[](int i) const { return i < size() ? neighbours[i] : opposites[i - size()]; }
  bool is_quadrilateral(int i) const { return opposites[i] != no_corner; }
};

/// What elements a ring has.
enum class RingKind : std::uint8_t { triangles, quadrilaterals, both };

/// A view of one-rings, in the numbering of the input or in another one (see input()). Vertices from size() on have no
/// ring: they are fixed.
struct RingView {
  std::span<const std::int64_t> offsets;         ///< vertex v has neighbours[offsets[v] .. offsets[v + 1]); maybe none
  std::span<const std::int32_t> neighbours;      ///< in ring order
  std::span<const std::int32_t> input_index;     ///< the input's number of each vertex; empty: the same
  std::span<const std::int32_t> opposites = {};  ///< as OneRings::opposites

  std::int32_t size() const { return offsets.empty() ? 0 : static_cast<std::int32_t>(offsets.size() - 1); }
  std::span<const std::int32_t> operator[](std::int32_t vertex) const {
    return neighbours.subspan(static_cast<std::size_t>(offsets[vertex]),
                              static_cast<std::size_t>(offsets[vertex + 1] - offsets[vertex]));
  }
  bool has_quadrilaterals() const { return !opposites.empty(); }
  /// The ring where quadrilaterals may be in it.
  MixedRingNumbers mixed(std::int32_t vertex) const {
    const std::span<const std::int32_t> ring = (*this)[vertex];
    return {ring, opposites.subspan(static_cast<std::size_t>(offsets[vertex]), ring.size())};
  }
  /// What visit() returns of the ring: of its neighbours, or of a MixedRing where quadrilaterals may be in it.
  template <class Visit>
  decltype(auto) with_ring(std::int32_t vertex, const Visit& visit) const {
    return has_quadrilaterals() ? visit(mixed(vertex)) : visit((*this)[vertex]);
  }
  /// Complexity: linear in the ring where there are quadrilaterals at all.
  RingKind kind(std::int32_t vertex) const {
    if (!has_quadrilaterals()) {
      return RingKind::triangles;
    }
    const std::span<const std::int32_t> around = mixed(vertex).opposites;
    const auto triangles = std::ranges::count(around, no_corner);
    return triangles == std::ssize(around) ? RingKind::triangles
           : triangles == 0                ? RingKind::quadrilaterals
                                           : RingKind::both;
  }
  /// Calls visit(other) for all other vertices of the elements around a vertex: once for each neighbour, and for each
  /// quadrilateral.
  template <class Visit>
  void for_vertices_around(std::int32_t vertex, const Visit& visit) const {
    for (const std::int32_t neighbour : (*this)[vertex]) {
      visit(neighbour);
    }
    if (has_quadrilaterals()) {
      for (const std::int32_t opposite : mixed(vertex).opposites) {
        if (opposite != no_corner) {
          visit(opposite);
        }
      }
    }
  }
  bool is_free(std::int32_t vertex) const { return vertex < size() && offsets[vertex] != offsets[vertex + 1]; }
  std::int32_t input(std::int32_t vertex) const { return input_index.empty() ? vertex : input_index[vertex]; }
};

/// The one-rings of a mesh's free vertices, all that the smoothing knows of the mesh. Ring i of vertex v: its
/// neighbours counter-clockwise, beginning with the one of the smallest index; v's elements are the triangles
/// (v, n_i, n_i+1), or with o_i, the opposite vertex, the quadrilaterals (v, n_i, o_i, n_i+1).
struct OneRings {
  BulkVector<std::int64_t> offsets{0};  ///< vertex v has neighbours[offsets[v] .. offsets[v + 1]); fixed ones: none
  BulkVector<std::int32_t> neighbours;  ///< vertex indices
  /// One a neighbour: the vertex opposite in the element between that and the next one, no_corner in a triangle. Empty
  /// where there are triangles alone.
  BulkVector<std::int32_t> opposites;

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(offsets.size() - 1); }
  std::span<const std::int32_t> operator[](std::int32_t vertex) const {
    return std::span(neighbours)
        .subspan(static_cast<std::size_t>(offsets[vertex]),
                 static_cast<std::size_t>(offsets[vertex + 1] - offsets[vertex]));
  }
  bool is_free(std::int32_t vertex) const { return offsets[vertex] != offsets[vertex + 1]; }
  RingView view() const { return {offsets, neighbours, {}, opposites}; }
  /// Room for `size(vertex)` neighbours of each vertex; `neighbours` are to be filled in, all of them.
  template <class Size>
  static OneRings with_sizes(std::int32_t vertex_count, const Size& size) {
    Workers one(1);
    return with_sizes(vertex_count, size, one);
  }
  /// with_sizes() on several threads.
  template <class Size>
  static OneRings with_sizes(std::int32_t vertex_count, const Size& size, Workers& workers) {
    OneRings rings;
    rings.offsets.resize(static_cast<std::size_t>(vertex_count) + 1);
    prefix_sums<std::int64_t>(
        rings.offsets, [&](std::int64_t v) { return size(static_cast<std::int32_t>(v)); }, workers);
    rings.neighbours.resize(static_cast<std::size_t>(rings.offsets.back()));
    return rings;
  }
  /// Fills the ring of `vertex` from `next()`, which answers its neighbours counter-clockwise, beginning anywhere, and
  /// turns it so that the smallest comes first.
  template <class Next>
  void fill(std::int32_t vertex, Next next) {
    std::int32_t* const ring = neighbours.data() + offsets[vertex];
    const std::int64_t size = offsets[vertex + 1] - offsets[vertex];
    std::array<std::int32_t, 16> found;
    if (size > std::ssize(found)) {
      std::generate(ring, ring + size, std::move(next));
      std::rotate(ring, std::min_element(ring, ring + size), ring + size);
      return;
    }
    std::int64_t smallest = 0;
    for (std::int64_t i = 0; i < size; ++i) {
      found[i] = next();
      smallest = found[i] < found[smallest] ? i : smallest;
    }
    for (std::int64_t i = 0; i < size; ++i) {
      ring[i] = found[smallest];
      smallest = smallest + 1 == size ? 0 : smallest + 1;
    }
  }
  /// fill() where quadrilaterals may be in the ring: `next()` answers each neighbour with the vertex opposite in the
  /// element between that and the next one, a std::pair. There is room for `opposites`.
  template <class Next>
  void fill_mixed(std::int32_t vertex, Next next) {
    const auto first = neighbours.begin() + offsets[vertex];
    const auto last = neighbours.begin() + offsets[vertex + 1];
    const auto first_opposite = opposites.begin() + offsets[vertex];
    auto opposite = first_opposite;
    for (auto neighbour = first; neighbour != last; ++neighbour, ++opposite) {
      std::tie(*neighbour, *opposite) = next();
    }
    const auto smallest = std::min_element(first, last);
    std::rotate(first_opposite, first_opposite + (smallest - first), opposite);
    std::rotate(first, smallest, last);
  }
};

/// The one-rings of the vertices whose `fixed` byte is 0. Complexity: linear.
OneRings one_rings(const TriangleTopology& topology, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers);

/// Those of a mesh with quadrilaterals, with their opposite vertices. Complexity: linear.
OneRings one_rings(const TriangleTopology& topology, std::span<const MixedElement> elements,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers);

OneRings one_rings(const ListedRings& listed, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers);
/// one_rings(), for the last time: where the rings are those that are listed, they are handed over.
OneRings one_rings(ListedRings&& listed, std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                   std::span<const std::uint8_t> fixed, Workers& workers);

}  // namespace trismooth

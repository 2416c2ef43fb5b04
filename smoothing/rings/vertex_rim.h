// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace trismooth {

/// A side of a triangle, opposite of the corner that is looked from; it runs as the triangle is listed.
struct RimEdge {
  std::int32_t from;
  std::int32_t to;
};

/// How the triangles around a vertex hang together, where all of them are listed alike.
enum class Fan : std::uint8_t {
  closed,  ///< once around the vertex
  open,    ///< from one boundary edge to another
  other    ///< not one fan, or not listed alike, or an edge of three triangles or more, or of two with the same corners
};

/// More triangles around a vertex are not walked around: every step looks at all of them.
inline constexpr std::size_t most_rim_edges = 64;

/// The edges of a rim by the vertices at which they begin, of which `Size` are looked at together and without
/// branches: which one it is cannot be guessed.
template <std::size_t Size>
class RimBegins {
 public:
  explicit RimBegins(std::span<const RimEdge> rim) {
    begins_.fill(-1);
    std::ranges::transform(rim, begins_.begin(), &RimEdge::from);
  }

  /// A bit for each edge that begins at `vertex`.
  auto at(std::int32_t vertex) const {
    std::conditional_t<Size <= 32, std::uint32_t, std::uint64_t> edges = 0;
    for (std::size_t i = 0; i < Size; ++i) {
      edges |= decltype(edges){begins_[i] == vertex} << i;
    }
    return edges;
  }

 private:
  std::array<std::int32_t, Size> begins_;
};

/// walk_rim() of no more than `Size` edges.
template <std::size_t Size, class Meet>
Fan walk_rim_of(std::span<const RimEdge> rim, const Meet& meet) {
  const RimBegins<Size> begins(rim);
  const auto size = static_cast<std::int32_t>(rim.size());
  std::int32_t met = 0;
  std::int32_t vertex = 0;
  // Meets vertices as long as each begins one edge, up to where the walk began, or as many as there are edges.
  const auto walk_from = [&](std::int32_t begin) {
    met = 0;
    vertex = begin;
    // (std::has_single_bit() counts all bits, by a call where the processor may have no instruction for it.)
    for (auto edges = begins.at(vertex); edges != 0 && (edges & (edges - 1)) == 0; edges = begins.at(vertex)) {
      const std::int32_t edge = std::countr_zero(edges);
      meet(met++, vertex, edge);
      vertex = rim[static_cast<std::size_t>(edge)].to;
      if (vertex == begin || met == size) {
        return;
      }
    }
  };
  const std::int32_t smallest = std::ranges::min(rim, {}, &RimEdge::from).from;
  walk_from(smallest);
  if (met == size && vertex == smallest) {
    return size > 2 ? Fan::closed : Fan::other;
  }
  // An open fan begins at the one vertex to which no edge runs. (Two such make two walks, neither over all edges.)
  const auto first = std::ranges::find_if(
      rim, [rim](const RimEdge& edge) { return std::ranges::find(rim, edge.from, &RimEdge::to) == rim.end(); });
  if (first == rim.end()) {
    return Fan::other;
  }
  walk_from(first->from);
  return met == size && begins.at(vertex) == 0 ? Fan::open : Fan::other;
}

/// Walks along the rim of a vertex (one edge at least, no more than most_rim_edges) and calls meet(i, vertex, edge)
/// for what it meets at place i: a vertex, and the number of the rim's edge that begins there. Where the rim is
/// closed, these are all of its vertices, from the smallest on; where it is open, the beginnings of all of its edges,
/// from one end to the other. Elsewhere they mean nothing. Places may be met twice: the last time counts.
template <class Meet>
Fan walk_rim(std::span<const RimEdge> rim, const Meet& meet) {
  return rim.size() <= 8    ? walk_rim_of<8>(rim, meet)
         : rim.size() <= 16 ? walk_rim_of<16>(rim, meet)
                            : walk_rim_of<most_rim_edges>(rim, meet);
}

}  // namespace trismooth

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_topology.h"

namespace trismooth {

/// A view of one-rings, in the numbering of the input or in another one (see input()). Vertices from size() on have no
/// ring: they are fixed.
struct RingView {
  std::span<const std::int64_t> offsets;      ///< vertex v has neighbours[offsets[v] .. offsets[v + 1]); maybe none
  std::span<const std::int32_t> neighbours;   ///< in ring order
  std::span<const std::int32_t> input_index;  ///< the input's number of each vertex; empty: the same

  std::int32_t size() const { return offsets.empty() ? 0 : static_cast<std::int32_t>(offsets.size() - 1); }
  std::span<const std::int32_t> operator[](std::int32_t vertex) const {
    return neighbours.subspan(static_cast<std::size_t>(offsets[vertex]),
                              static_cast<std::size_t>(offsets[vertex + 1] - offsets[vertex]));
  }
  bool is_free(std::int32_t vertex) const { return vertex < size() && offsets[vertex] != offsets[vertex + 1]; }
  std::int32_t input(std::int32_t vertex) const { return input_index.empty() ? vertex : input_index[vertex]; }
};

/// The one-rings of a mesh's free vertices, all that the smoothing knows of the mesh. Ring i of vertex v: its
/// neighbours counter-clockwise, beginning with the one of the smallest index; v's triangles are (v, n_i, n_i+1).
struct OneRings {
  std::vector<std::int64_t> offsets{0};  ///< vertex v has neighbours[offsets[v] .. offsets[v + 1]); fixed ones: none
  std::vector<std::int32_t> neighbours;  ///< vertex indices

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(offsets.size() - 1); }
  std::span<const std::int32_t> operator[](std::int32_t vertex) const {
    return std::span(neighbours)
        .subspan(static_cast<std::size_t>(offsets[vertex]),
                 static_cast<std::size_t>(offsets[vertex + 1] - offsets[vertex]));
  }
  bool is_free(std::int32_t vertex) const { return offsets[vertex] != offsets[vertex + 1]; }
  RingView view() const { return {offsets, neighbours, {}}; }
  /// Room for `size(vertex)` neighbours of each vertex; `neighbours` are to be filled in.
  template <class Size>
  static OneRings with_sizes(std::int32_t vertex_count, const Size& size) {
    OneRings rings;
    rings.offsets.resize(static_cast<std::size_t>(vertex_count) + 1);
    for (std::int32_t v = 0; v < vertex_count; ++v) {
      rings.offsets[v + 1] = rings.offsets[v] + size(v);
    }
    rings.neighbours.resize(static_cast<std::size_t>(rings.offsets.back()));
    return rings;
  }
  /// Fills the ring of `vertex` from `next()`, which answers its neighbours counter-clockwise, beginning anywhere, and
  /// turns it so that the smallest comes first.
  template <class Next>
  void fill(std::int32_t vertex, Next next) {
    const auto ring = std::span(neighbours).subspan(static_cast<std::size_t>(offsets[vertex]), (*this)[vertex].size());
    std::ranges::generate(ring, std::move(next));
    std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
  }
};

/// The one-rings of the vertices whose `fixed` byte is 0. Complexity: linear.
OneRings one_rings(const TriangleTopology& topology, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers);

}  // namespace trismooth

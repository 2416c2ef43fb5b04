#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/smoothing/triangle_topology.h"

namespace trismooth {

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
};

/// The one-rings of the vertices whose `fixed` byte is 0. Complexity: linear.
OneRings one_rings(const TriangleTopology& topology, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers);

/// Makes rings from a function that visits the neighbours of a free vertex counter-clockwise, beginning anywhere:
/// `visit(vertex, callback)` calls `callback(neighbour)` for each. Shared by every source of topology.
template <class Visit>
OneRings collect_one_rings(std::int32_t vertex_count, std::span<const std::uint8_t> fixed, Workers& workers,
                           const Visit& visit);

/// The smallest shape quotient of the triangles without a free vertex; infinity where there is none. The smoothing
/// cannot change it, so a quality target above it is never reached.
double smallest_fixed_quotient(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                               std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed);

}  // namespace trismooth

#include "trismooth/smoothing/one_rings_collect.h"

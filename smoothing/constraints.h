#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/smoothing/rings/triangle_topology.h"

namespace trismooth {

/// What the caller holds fixed beside what the mesh itself does (boundaries, non-manifold and bow-tie vertices,
/// isolated vertices). All views may be empty; the caller owns them.
struct Constraints {
  std::span<const std::uint8_t> fixed{};        ///< one flag a vertex; not zero: fixed
  std::span<const std::int32_t> fixed_ids{};    ///< vertex numbers
  std::span<const std::uint8_t> other_cells{};  ///< one flag a vertex: used by a cell that is not a triangle
  std::span<const std::int32_t> regions{};      ///< one number a triangle; ends of edges between two regions are fixed
};

/// Throws std::invalid_argument for a view of the wrong length and for the first vertex number out of range.
void check_constraints(const Constraints& constraints, std::int32_t vertex_count, std::int64_t triangle_count);

/// Why each vertex is fixed: the bits of namespace hold; 0 is a free vertex. Checks the constraints as
/// check_constraints() does. Complexity: linear.
std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const Triangle> triangles,
                                         const Constraints& constraints);

}  // namespace trismooth

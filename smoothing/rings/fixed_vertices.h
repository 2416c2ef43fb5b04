// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/constraints.h"

namespace trismooth {

class Workers;
struct ListedRings;

/// Adds what the constraints say of vertices to `reasons`, bits of namespace hold for each. Regions are apart: they are
/// for who knows the edges. The constraints have been checked. Complexity: linear.
void hold_named_vertices(const Constraints& constraints, std::span<std::uint8_t> reasons);

/// Why each vertex is fixed: the bits of namespace hold; 0 is a free vertex. Checks the constraints as
/// check_constraints() does. Complexity: linear.
std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const Triangle> triangles,
                                         const Constraints& constraints, Workers& workers);

std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const MixedElement> elements,
                                         const Constraints& constraints, Workers& workers);

std::vector<std::uint8_t> fixed_vertices(const ListedRings& listed, std::span<const Triangle> triangles,
                                         const Constraints& constraints, Workers& workers);

/// fixed_vertices() on the calling thread.
std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const Triangle> triangles,
                                         const Constraints& constraints);

}  // namespace trismooth

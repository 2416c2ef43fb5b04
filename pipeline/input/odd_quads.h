// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"

namespace trismooth {

struct PlanarMesh;

/// Takes the quadrilaterals whose corners are not listed in turn out of the mesh's elements. They are not convex, two
/// opposite sides are those of no other element, and a diagonal is one: nothing could be oriented with them. Each
/// counts as another cell, and as one of mesh.crossed_quads: it is kept, its vertices are held, and a note says so. One
/// that is not convex since its vertices are in the wrong places stays an element, which is inverted. To be called
/// before copies are taken out. Complexity: linear, and n log n in those that are not convex.
void hold_crossed_quads(PlanarMesh& mesh);

/// Whether hold_crossed_quads() may find one in a mesh of which a part is known: these elements, all that there are
/// around vertices for which `ghosts` has 0. It does find none where this is false of all parts and each vertex has a 0
/// in one of them. Complexity: linear, and n log n in those that are not convex.
bool may_have_crossed_quads(std::span<const Point2<double>> points, const ElementList& elements,
                            std::span<const std::uint8_t> ghosts);

/// What has no thickness on purpose.
struct ThinQuads {
  std::int64_t count = 0;
  std::vector<std::uint8_t> flags;  ///< per vertex: 1 where it is one of theirs; empty: there is none
};

/// The quadrilaterals of which two opposite sides, which have a length, lie in the same place with vertices of their
/// own, as elements of interfaces and cohesive zones have them, and that have a vertex which is not `held` yet (a byte
/// a vertex, or empty). `points`: x, y, z of every vertex. Complexity: linear.
ThinQuads find_thin_quads(const PlanarMesh& mesh, std::span<const double> points, std::span<const std::uint8_t> held);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

/// A halfedge mesh of elements that turn the same way within each component: vertex v is input vertex v, face e is
/// element e. A vertex whose elements form several fans (at bow ties and non-manifold edges), which no halfedge mesh
/// can hold, is there once for each fan: the copies come after the input's vertices and are listed by `copies_of`.
struct HalfedgeMesh {
  ElementMesh mesh;
  std::vector<std::int32_t> copies_of;  ///< the input vertex of mesh vertex vertex_count + i
  bool may_have_quadrilaterals = false;
};

/// Throws MeshError where a halfedge mesh of so many vertices (copies included), triangles and quadrilaterals, of whose
/// edges so many have one element or more than two, has more vertices or halfedges than OpenMesh's handles tell apart:
/// 2,147,483,647. Such an edge has two halfedges for each of its elements, every other one two.
void check_halfedge_mesh_size(std::int64_t vertices, std::int64_t triangles, std::int64_t unpaired_sides,
                              std::int64_t quadrilaterals = 0);

/// Builds the halfedge mesh in bulk, not face by face. `xyz` holds three coordinates of every vertex; `topology` is
/// that of the elements, and has no twins afterwards; `reversed` is 1 for each element whose face runs the other way
/// round than the element is listed: MatchedSides::parity, or that with whole components turned over. Throws MeshError
/// for a mesh that is too large, see check_halfedge_mesh_size(). Complexity: linear.
HalfedgeMesh build_halfedge_mesh(std::span<const double> xyz, const ElementList& elements, TriangleTopology& topology,
                                 std::span<const std::uint8_t> reversed, Workers& workers);

/// The one-rings, in the input's numbering, of the vertices whose `fixed` byte is 0; those must be interior vertices.
/// There is a byte for each vertex of the input, and in `degree` how many elements it has. `reversed`, one byte a
/// face, tells faces of components that the mesh orients clockwise; empty: there are none. Complexity: linear.
OneRings one_rings(const HalfedgeMesh& halfedges, std::span<const std::int32_t> degree,
                   std::span<const std::uint8_t> fixed, std::span<const std::uint8_t> reversed, Workers& workers);

}  // namespace trismooth

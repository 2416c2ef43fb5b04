// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

class Workers;

/// A halfedge mesh, and what else is known of its connectivity: `topology` is that of its elements, without twins.
struct ConnectedMesh {
  HalfedgeMesh halfedges;
  TriangleTopology topology;
};

/// Connects elements by way of a halfedge mesh: `xyz` has three coordinates of each of its vertices. Throws MeshError
/// as connect_triangles() does, and for more elements than a halfedge mesh can hold. Complexity: linear, but for
/// sorting the edges of each vertex.
ConnectedMesh connect_halfedges(std::span<const double> xyz, const ElementList& elements, Workers& workers);

/// What find_mesh_rings() finds, in every number and with the same errors of the constraints, read from halfedges.
/// `local` are the points in the local frame, `elements` those that were connected. Complexity: linear.
MeshRings read_halfedge_rings(const ConnectedMesh& connected, std::span<const Point2<double>> local,
                              const ElementList& elements, const Constraints& constraints, Workers& workers,
                              Layers layers = Layers::smooth);

}  // namespace trismooth

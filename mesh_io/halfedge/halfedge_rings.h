// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

class Workers;

/// A halfedge mesh, and what else is known of its connectivity: `topology` is that of its triangles, without twins.
struct ConnectedMesh {
  HalfedgeMesh halfedges;
  TriangleTopology topology;
};

/// Connects triangles by way of a halfedge mesh, whose vertices they are: `xyz` has three coordinates of each. Throws
/// MeshError as connect_triangles() does, and for more triangles than a halfedge mesh can hold. Complexity: linear, but
/// for sorting the edges of each vertex.
ConnectedMesh connect_halfedges(std::span<const double> xyz, std::span<const Triangle> triangles, Workers& workers);

/// What find_mesh_rings() finds, in every number and with the same errors of the constraints, read from halfedges.
/// `local` are the points in the local frame, `triangles` those that were connected. Complexity: linear.
MeshRings read_halfedge_rings(const ConnectedMesh& connected, std::span<const Point2<double>> local,
                              std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                              Layers layers = Layers::smooth);

}  // namespace trismooth

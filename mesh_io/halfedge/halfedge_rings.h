#pragma once

#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

class Workers;

/// What find_mesh_rings() finds, in every number and with the same errors, by halfedges. The halfedge mesh of the
/// triangles is built, once; orientation, constraints and rings are read from it. `xyz` holds three coordinates of
/// every vertex, `local` are the points in the local frame. Throws MeshError for more triangles than a halfedge mesh
/// can hold, too. Complexity: linear, but for sorting the edges of each vertex.
MeshRings find_halfedge_rings(std::span<const double> xyz, std::span<const Point2<double>> local,
                              std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                              Layers layers = Layers::smooth);

/// The same, read from a halfedge mesh that is there; `triangles` is its face_list(). Complexity: linear.
MeshRings read_halfedge_rings(const TriangleMesh& mesh, std::span<const Point2<double>> local,
                              std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                              Layers layers = Layers::smooth);

}  // namespace trismooth

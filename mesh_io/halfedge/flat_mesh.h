// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/halfedge/mesh_constraints.h"
#include "trismooth/smoothing/rings/kept_constraints.h"

namespace trismooth {

class Workers;

/// The faces of an OpenMesh mesh as triangles of flat arrays. Vertices have the numbers that they have in the mesh.
struct FlatMesh {
  std::int64_t vertices = 0;
  std::int64_t all_faces = 0;           ///< deleted ones as well
  std::vector<Triangle> triangles;      ///< the faces that are not deleted, in their order, as they run
  std::vector<std::int32_t> faces;      ///< which face each triangle is
  std::vector<std::uint8_t> in_a_cell;  ///< one flag a vertex: of a face that is not deleted
};

/// Throws std::invalid_argument for a face that is no triangle. Complexity: linear.
FlatMesh flat_mesh(const OpenMesh::PolyConnectivity& mesh);

/// Whether the faces of `mesh`, which has as many vertices and faces as that of `flat`, are deleted where they were and
/// have the same corners elsewhere. Complexity: linear.
bool has_faces_of(const OpenMesh::PolyConnectivity& mesh, const FlatMesh& flat, Workers& workers);

/// What the caller and the status of the mesh hold, for flat arrays of the triangles of `flat`. Throws
/// std::invalid_argument as ElementNumbers::of() does. Complexity: linear, n log n for regions beyond 32 bits.
KeptConstraints flat_constraints(const OpenMesh::PolyConnectivity& mesh, const FlatMesh& flat,
                                 const MeshConstraints& constraints);

}  // namespace trismooth

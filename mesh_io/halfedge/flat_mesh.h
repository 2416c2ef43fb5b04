// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include "trismooth/base/cell_list.h"
#include "trismooth/base/element_list.h"
#include "trismooth/mesh_io/halfedge/mesh_constraints.h"
#include "trismooth/smoothing/rings/kept_constraints.h"

namespace trismooth {

class Workers;

/// The faces of an OpenMesh mesh that are not deleted, in their order and as they run: those of three and four sides as
/// elements of flat arrays, those of more as other cells. Vertices have the numbers that they have in the mesh.
struct FlatMesh {
  std::int64_t vertices = 0;
  std::int64_t all_faces = 0;               ///< deleted ones as well
  OwnElements elements;                     ///< listed as triangles where all are
  std::vector<std::int32_t> faces;          ///< which face each element is
  CellList polygons;                        ///< the faces of five sides or more
  std::vector<std::int32_t> polygon_faces;  ///< which face each of these is
  std::vector<std::uint8_t> in_a_cell;      ///< one flag a vertex: of any of these faces
};

/// Throws std::invalid_argument for a face of fewer than three sides. Complexity: linear.
FlatMesh flat_mesh(const OpenMesh::PolyConnectivity& mesh);

/// All faces of `mesh` as cells: those that limit how far a vertex may be from its plane (see fit_plane()). Linear.
CellList cells_of(const FlatMesh& mesh);

/// Whether the faces of `mesh`, which has as many vertices and faces as that of `flat`, are deleted where they were and
/// have the same corners elsewhere. Complexity: linear.
bool has_faces_of(const OpenMesh::PolyConnectivity& mesh, const FlatMesh& flat, Workers& workers);

/// What the caller, the status of the mesh and its faces of five sides or more hold, for flat arrays of the elements of
/// `flat`. Throws std::invalid_argument as ElementNumbers::of() does. Complexity: linear, n log n for regions beyond 32
/// bits.
KeptConstraints flat_constraints(const OpenMesh::PolyConnectivity& mesh, const FlatMesh& flat,
                                 const MeshConstraints& constraints);

}  // namespace trismooth

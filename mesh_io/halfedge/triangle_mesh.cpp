// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"

namespace trismooth {

std::vector<Triangle> face_list(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles(mesh.n_faces());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    OpenMesh::HalfedgeHandle h = mesh.halfedge_handle(OpenMesh::FaceHandle(static_cast<int>(f)));
    for (std::int32_t& corner : triangles[f]) {
      corner = mesh.from_vertex_handle(h).idx();
      h = mesh.next_halfedge_handle(h);
    }
  }
  return triangles;
}

}  // namespace trismooth

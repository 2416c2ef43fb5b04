// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"

#include <stdexcept>
#include <string>

namespace trismooth {

std::vector<Triangle> face_list(const OpenMesh::PolyConnectivity& mesh) {
  std::vector<Triangle> triangles(mesh.n_faces());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const OpenMesh::HalfedgeHandle first = mesh.halfedge_handle(OpenMesh::FaceHandle(static_cast<int>(f)));
    OpenMesh::HalfedgeHandle h = first;
    for (std::int32_t& corner : triangles[f]) {
      corner = mesh.from_vertex_handle(h).idx();
      h = mesh.next_halfedge_handle(h);
    }
    if (h != first) {
      throw std::invalid_argument("face " + std::to_string(f) + " is no triangle");
    }
  }
  return triangles;
}

}  // namespace trismooth

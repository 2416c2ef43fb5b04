// SPDX-License-Identifier: BSD-3-Clause
// The component halfedge alone: four triangles around a vertex that is not in the middle of them, once in the mesh of
// this project and once in one with traits of the program's own, where a corner of it is locked as well.
#include <cstdio>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "trismooth/mesh_io/halfedge/mesh_quality.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"

namespace {

struct OwnTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec2f;
  VertexAttributes(OpenMesh::Attributes::Status);
};
using OwnMesh = OpenMesh::PolyMesh_ArrayKernelT<OwnTraits>;

template <class Mesh, class Place>
OpenMesh::VertexHandle four_triangles(Mesh& mesh, const Place& place) {
  const auto middle = mesh.add_vertex(place(0.75, 0.5));
  const auto corners = {mesh.add_vertex(place(-1, -1)), mesh.add_vertex(place(1, -1)), mesh.add_vertex(place(1, 1)),
                        mesh.add_vertex(place(-1, 1))};
  for (auto a = corners.begin(); a != corners.end(); ++a) {
    mesh.add_face(middle, *a, a + 1 == corners.end() ? *corners.begin() : *(a + 1));
  }
  return middle;
}

}  // namespace

int main() {
  trismooth::TriangleMesh mesh;
  const auto middle = four_triangles(mesh, [](double x, double y) { return Eigen::Vector3d(x, y, 0); });
  const trismooth::SmoothingResult result = trismooth::smooth(mesh);
  std::printf("%lld vertices moved, the middle to %g %g\n", static_cast<long long>(result.moved_vertices),
              mesh.point(middle).x(), mesh.point(middle).y());

  OwnMesh own;
  const auto own_middle = four_triangles(
      own, [](double x, double y) { return OpenMesh::Vec2f(static_cast<float>(x), static_cast<float>(y)); });
  const double before = trismooth::quality(own)[trismooth::Metric::shape].min;
  own.status(own_middle).set_locked(true);
  trismooth::smooth(own);
  const bool is_held = own.point(own_middle) == OpenMesh::Vec2f(0.75F, 0.5F);
  own.status(own_middle).set_locked(false);
  trismooth::plan(own).smooth(own);
  const double after = trismooth::quality(own)[trismooth::Metric::shape].min;
  std::printf("smallest shape %g, then %g\n", before, after);
  const bool is_right = mesh.point(middle) == Eigen::Vector3d::Zero() && is_held &&
                        own.point(own_middle) == OpenMesh::Vec2f(0, 0) && after > before;
  return is_right ? 0 : 1;
}

// The component halfedge alone: four triangles around a vertex that is not in the middle of them.
#include <cstdio>

#include "trismooth/mesh_io/halfedge/smooth_mesh.h"

int main() {
  trismooth::TriangleMesh mesh;
  const auto middle = mesh.add_vertex({0.9, 0.8, 0});
  const auto corners = {mesh.add_vertex({-1, -1, 0}), mesh.add_vertex({1, -1, 0}), mesh.add_vertex({1, 1, 0}),
                        mesh.add_vertex({-1, 1, 0})};
  for (auto a = corners.begin(); a != corners.end(); ++a) {
    mesh.add_face(middle, *a, a + 1 == corners.end() ? *corners.begin() : *(a + 1));
  }
  const trismooth::SmoothingResult result = trismooth::smooth(mesh);
  std::printf("%lld vertices moved, the middle to %g %g\n", static_cast<long long>(result.moved_vertices),
              mesh.point(middle).x(), mesh.point(middle).y());
  return mesh.point(middle) == Eigen::Vector3d::Zero() ? 0 : 1;
}

// Smoothing a halfedge mesh (OpenMesh with Eigen points) of one's own, with a progress callback.
// Usage: smooth_openmesh MESH. Link with trismooth::mesh_io.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>

#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/quality/triangle_quality.h"

namespace {

/// For the Cancel button of a program with windows; its thread would set it.
std::atomic<bool> cancel_pressed{false};

/// Any program fills its mesh like this, from whatever it has; here from a file, for the sake of the example.
trismooth::TriangleMesh load(const char* path) {
  const trismooth::MeshDocument document = trismooth::read_mesh(path);
  trismooth::TriangleMesh mesh;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    mesh.add_vertex({document.points[3 * v], document.points[3 * v + 1], document.points[3 * v + 2]});
  }
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    const auto corners = document.cells[cell];
    if (document.cells.types[cell] == trismooth::cell_type::triangle) {
      mesh.add_face(mesh.vertex_handle(corners[0]), mesh.vertex_handle(corners[1]), mesh.vertex_handle(corners[2]));
    }
  }
  return mesh;
}

/// The smallest shape of the mesh's triangles, which lie in the xy plane: 1 is equilateral, 0 degenerate.
double worst_shape(const trismooth::TriangleMesh& mesh) {
  const auto point = [&](std::int32_t v) {
    const Eigen::Vector3d& p = mesh.point(mesh.vertex_handle(v));
    return trismooth::Point2<double>{p.x(), p.y()};
  };
  double worst = 1;
  for (const auto& [a, b, c] : trismooth::face_list(mesh)) {
    worst = std::min(worst, trismooth::shape(point(a), point(b), point(c)));
  }
  return worst;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: smooth_openmesh MESH\n", stderr);
    return 2;
  }
  try {
    trismooth::TriangleMesh mesh = load(argv[1]);
    const double before = worst_shape(mesh);

    trismooth::SmoothingOptions options;
    options.tolerance = 1e-3;  // stop when no vertex moves by more than this part of its edges
    // Called after every sweep. Whenever it answers `stop`, the mesh is left valid and no worse than it was.
    options.progress = [](const trismooth::SweepRecord& sweep) {
      std::printf("sweep %3lld: %5lld vertices moved, at most by %.1e of their edges\n",
                  static_cast<long long>(sweep.sweep), static_cast<long long>(sweep.moved), sweep.max_relative_move);
      return cancel_pressed ? trismooth::Progress::stop : trismooth::Progress::proceed;
    };
    const trismooth::SmoothingResult result = trismooth::smooth(mesh, options);

    const double after = worst_shape(mesh);
    std::printf("%lld of %zu vertices moved, worst shape %.3f -> %.3f (stopped: %s)\n",
                static_cast<long long>(result.moved_vertices), mesh.n_vertices(), before, after,
                trismooth::to_string(result.stop_reason).data());
    return after > before ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

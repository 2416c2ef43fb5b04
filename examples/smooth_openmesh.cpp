// SPDX-License-Identifier: BSD-3-Clause
// Smoothing an OpenMesh mesh of one's own type, with a progress callback.
// Usage: smooth_openmesh MESH. Link with trismooth::halfedge (and trismooth::mesh_io, for the file).

#include <atomic>
#include <cstdio>
#include <exception>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "trismooth/mesh_io/halfedge/mesh_quality.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/mesh_io/mesh_file.h"

namespace {

/// Whatever a program has: here points of double, with a status that can lock vertices.
struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// For the Cancel button of a program with windows; its thread would set it.
std::atomic<bool> cancel_pressed{false};

/// Any program fills its mesh like this, from whatever it has; here from a file, for the sake of the example.
Mesh load(const char* path) {
  const trismooth::MeshDocument document = trismooth::read_mesh(path);
  Mesh mesh;
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

/// The smallest shape of the mesh's triangles: 1 is equilateral, 0 degenerate.
double worst_shape(const Mesh& mesh) {
  return trismooth::quality(mesh)[trismooth::Metric::shape].min;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: smooth_openmesh MESH\n", stderr);
    return 2;
  }
  try {
    Mesh mesh = load(argv[1]);
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

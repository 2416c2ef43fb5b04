// What smoothing does for a plate that is pulled, with a hole around (X, Y): errors and iterations on a mesh as it is,
// and smoothed by each method. The rim of that hole is free, the rest of the boundary moves as in the infinite plate.
// Usage: plane_stress MESH X Y RADIUS [METHOD]... Link with trismooth::mesh_io, trismooth::smoothing and Eigen.

#include "plane_stress.h"

#include <cstdio>
#include <exception>
#include <string>

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "usage: plane_stress MESH X Y RADIUS [METHOD]...\n");
    return 2;
  }
  try {
    const fem::Mesh mesh = fem::read(argv[1]);
    const Eigen::Vector2d centre(std::stod(argv[2]), std::stod(argv[3]));
    const double radius = std::stod(argv[4]);
    const fem::Material material;
    const fem::KnownDisplacement known = fem::kirsch(centre, radius, material);
    const auto problem = [&](const fem::Mesh& one) {
      const auto on_rim = [&](int v) { return (one.points.col(v) - centre).norm() < 1.001 * radius; };
      return fem::solve_plane_stress(one, material, known,
                                     [&](const fem::BoundaryEdge& e) { return on_rim(e.a) && on_rim(e.b); });
    };
    fem::print(fem::compare(mesh, {argv + 5, argv + argc}, problem));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plane_stress: %s\n", error.what());
    return 1;
  }
}

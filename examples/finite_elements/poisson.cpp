// SPDX-License-Identifier: BSD-3-Clause
// What smoothing does for a Poisson problem: errors and iterations on a mesh as it is, and smoothed by each method.
// Usage: poisson MESH [METHOD]... Link with trismooth::mesh_io, trismooth::smoothing and Eigen.

#include "poisson.h"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: poisson MESH [METHOD]...\n");
    return 2;
  }
  try {
    // The solution has two and three half waves in the unit square. Other meshes are scaled to fit in.
    fem::Mesh mesh = fem::read(argv[1]);
    const Eigen::Vector2d lowest = mesh.points.rowwise().minCoeff();
    const double extent = (mesh.points.rowwise().maxCoeff() - lowest).maxCoeff();
    mesh.points = (mesh.points.colwise() - lowest) / extent;
    fem::print(fem::compare(mesh, {argv + 2, argv + argc},
                            [](const fem::Mesh& one) { return fem::solve_poisson(one, fem::waves()); }));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "poisson: %s\n", error.what());
    return 1;
  }
}

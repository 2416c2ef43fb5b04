// SPDX-License-Identifier: BSD-3-Clause
// What smoothing does for a plate that is pulled, with a hole around (X, Y): errors and iterations on a mesh as it is,
// and smoothed by each method. The rim of that hole is free, the rest of the boundary moves as in the infinite plate.
// Usage: plane_stress MESH X Y RADIUS [METHOD]... Link with trismooth::mesh_io, trismooth::smoothing and Eigen.

#include "plane_stress.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

namespace {

double number(const char* text) {
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (end == text || *end != '\0') {
    throw std::runtime_error(std::string("not a number: ") + text);
  }
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "usage: plane_stress MESH X Y RADIUS [METHOD]...\n");
    return 2;
  }
  try {
    const fem::Mesh mesh = fem::read(argv[1]);
    const Eigen::Vector2d centre(number(argv[2]), number(argv[3]));
    const double radius = number(argv[4]);
    const fem::Material material;
    const fem::KnownDisplacement known = fem::kirsch(centre, radius, material);
    const auto loaded = fem::on_rim(mesh, centre, radius);  // smoothing leaves the boundary where it is
    const auto problem = [&](const fem::Mesh& one) { return fem::solve_plane_stress(one, material, known, loaded); };
    fem::print(fem::compare(mesh, {argv + 5, argv + argc}, problem));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plane_stress: %s\n", error.what());
    return 1;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// The component mesh_io alone: the mesh that is named is written in another format, read back and compared.
#include <cstdio>
#include <filesystem>

#include "trismooth/mesh_io/mesh_file.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    return 2;
  }
  const trismooth::MeshDocument mesh = trismooth::read_mesh(argv[1]);
  trismooth::write_mesh(argv[2], mesh);
  const trismooth::MeshDocument copy = trismooth::read_mesh(argv[2]);
  std::printf("%zu points, %zu cells\n", copy.point_count(), copy.cells.size());
  return copy.points == mesh.points && copy.cells.size() == mesh.cells.size() ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/mesh_file.h"

#include "support/test_meshes.h"

/// A mesh of the tests as a document, at the height `z`.
inline trismooth::MeshDocument triangle_document(const test_meshes::Mesh& mesh, double z = 0) {
  trismooth::MeshDocument document;
  for (const auto& [x, y] : mesh.points) {
    document.points.insert(document.points.end(), {x, y, z});
  }
  for (const trismooth::Triangle& triangle : mesh.triangles) {
    document.cells.append(trismooth::cell_type::triangle, triangle);
  }
  return document;
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "trismooth/mesh_io/mesh_document.h"

#include "support/mixed_meshes.h"

namespace mixed_meshes {

/// The mesh as a document, a cell an element.
inline trismooth::MeshDocument document_of(const MixedMesh& mesh) {
  trismooth::MeshDocument document;
  document.format = trismooth::FileFormat::vtk;
  for (const auto& [x, y] : mesh.points) {
    document.points.insert(document.points.end(), {x, y, 0});
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    document.cells.append(mesh.is_triangle(e) ? trismooth::cell_type::triangle : trismooth::cell_type::quad,
                          mesh.corners(e));
  }
  return document;
}

}  // namespace mixed_meshes

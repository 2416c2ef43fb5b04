// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/random_document.h"

namespace trismooth {

MeshDocument document_of(const RandomMesh& mesh) {
  MeshDocument document;
  document.points.reserve(3 * mesh.points.size());
  for (const Point2<double>& point : mesh.points) {
    document.points.insert(document.points.end(), {point.x, point.y, 0.0});
  }
  for (const auto& triangle : mesh.triangles) {
    document.cells.append(cell_type::triangle, triangle);
  }
  return document;
}

}  // namespace trismooth

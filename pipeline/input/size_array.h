// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

/// Sizes that an array of the file asks for.
struct SizeArray {
  std::string array;            ///< its name in the file
  bool of_cells = false;        ///< areas of cells, not edge lengths at points
  std::vector<double> lengths;  ///< per vertex: the edge length asked for around it; 0 of vertices in no element
};

/// The sizes by the point array `name`, which has edge lengths, or else by the cell array of that name, which has
/// areas: a vertex is asked for the edge length of an equilateral triangle with the mean area of the triangles around
/// it, of a quadrilateral half of its area. The triangles of a strip share its area evenly. Where no array has that
/// very name, one counts whose name differs from it in case, blanks and the like. Throws std::invalid_argument where
/// the document has no such array, where it has texts or several components, and for a value at an element that is not
/// a positive number. Complexity: linear.
SizeArray find_size_array(const MeshDocument& document, const PlanarMesh& mesh, const std::string& name);

}  // namespace trismooth

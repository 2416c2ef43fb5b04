#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/pipeline/input/value_numbers.h"

namespace trismooth {

class Workers;
struct PlanarMesh;

/// A triangle that a document lists again.
struct RepeatedTriangle {
  std::int32_t triangle;  ///< the one of the mesh that it is a copy of
  std::int32_t cell;      ///< of the document

  bool operator==(const RepeatedTriangle&) const = default;
};

/// Takes triangles that have the vertices of an earlier one, in whatever order, out of those of the mesh: they are
/// `repeats` then, and a note tells how many there are and which is the first. Programs list triangles again for every
/// group that has them; a copy is no neighbour of anything. Triangles of six nodes that share their corners alone are
/// no copies. Complexity: linear, and n log n in the triangles that are there more than once; a mesh without any pays a
/// pass over its triangles and two bytes for each, for a while.
void take_out_repeats(PlanarMesh& mesh, Workers& workers);

/// The values of a one-component cell array at the triangles of the mesh, numbered as number_values() does. A triangle
/// that is listed with several values has the set of them in place of one: a value of its own, behind all others. So
/// groups that overlap keep their interfaces. Complexity: as number_values(), and n log n in the repeats.
ValueNumbers number_values_of_triangles(const DataArray& array, const PlanarMesh& mesh);

/// The cells of the copies of a triangle, in the document's order. Complexity: log n in the repeats.
std::span<const RepeatedTriangle> copies_of(const PlanarMesh& mesh, std::int32_t triangle);

}  // namespace trismooth

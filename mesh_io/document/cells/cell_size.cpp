// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/cell_size.h"

#include "trismooth/base/text/counted.h"

namespace trismooth {

namespace {

constexpr CellSize exactly(std::size_t vertices) {
  return {vertices, vertices};
}
constexpr CellSize at_least(std::size_t vertices) {
  return {.least = vertices};
}

}  // namespace

CellSize cell_size_of(std::uint8_t type) {
  // As vtkCellType.h numbers them.
  switch (type) {
    case 0:  // empty
      return exactly(0);
    case 1:  // vertex
      return exactly(1);
    case 2:  // poly-vertex
      return at_least(1);
    case 3:  // line
      return exactly(2);
    case 4:  // poly-line
      return at_least(2);
    case 5:   // triangle
    case 21:  // quadratic edge
      return exactly(3);
    case 6:  // triangle strip
    case 7:  // polygon
      return at_least(3);
    case 8:   // pixel
    case 9:   // quad
    case 10:  // tetrahedron
    case 35:  // cubic line
      return exactly(4);
    case 14:  // pyramid
      return exactly(5);
    case 13:  // wedge
    case 22:  // quadratic triangle
    case 30:  // quadratic linear quad
      return exactly(6);
    case 34:  // biquadratic triangle
      return exactly(7);
    case 11:  // voxel
    case 12:  // hexahedron
    case 23:  // quadratic quad
      return exactly(8);
    case 28:  // biquadratic quad
      return exactly(9);
    case 15:  // pentagonal prism
    case 24:  // quadratic tetrahedron
      return exactly(10);
    case 16:  // hexagonal prism
    case 31:  // quadratic linear wedge
      return exactly(12);
    case 27:  // quadratic pyramid
      return exactly(13);
    case 26:  // quadratic wedge
      return exactly(15);
    case 32:  // biquadratic quadratic wedge
      return exactly(18);
    case 37:  // triquadratic pyramid
      return exactly(19);
    case 25:  // quadratic hexahedron
      return exactly(20);
    case 33:  // biquadratic quadratic hexahedron
      return exactly(24);
    case 29:  // triquadratic hexahedron
      return exactly(27);
    default:
      return {};
  }
}

std::string describe_wrong_size(std::uint8_t type, std::size_t vertices) {
  const CellSize size = cell_size_of(type);
  return "of type " + std::to_string(type) + " has " + counted(vertices, "vertex", "vertices") + "; expected " +
         std::to_string(size.least) + (size.least == size.most ? "" : " or more");
}

}  // namespace trismooth

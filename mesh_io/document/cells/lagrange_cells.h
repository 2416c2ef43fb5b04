// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The type of the same cell, whose vertices have the same order, in place of VTK's Lagrange curves, triangles and
/// quadrilaterals of order 1 and 2, whose order is in the number of vertices; other types as they are.
constexpr std::uint8_t type_of_fixed_order(std::uint8_t type, std::size_t vertices) {
  switch (type) {
    case cell_type::lagrange_curve:
      return vertices == 2 ? cell_type::line : vertices == 3 ? cell_type::quadratic_edge : type;
    case cell_type::lagrange_triangle:
      return vertices == 3 ? cell_type::triangle : vertices == 6 ? cell_type::quadratic_triangle : type;
    case cell_type::lagrange_quad:
      return vertices == 4 ? cell_type::quad : vertices == 9 ? cell_type::biquadratic_quad : type;
    default:
      return type;
  }
}

/// type_of_fixed_order(), and polygons of three and four vertices are triangles and quadrilaterals.
constexpr std::uint8_t ordinary_type(std::uint8_t type, std::size_t vertices) {
  const bool is_small = type == cell_type::polygon && (vertices == 3 || vertices == 4);
  return is_small ? cell_type::of_face(vertices) : type_of_fixed_order(type, vertices);
}

/// True where ordinary_type() is another one for any cell.
bool has_cells_of_any_order(const MeshDocument& document);

/// The document with those types; without an original. For formats that have no cells of any order. Linear.
MeshDocument with_fixed_orders(const MeshDocument& document);

}  // namespace trismooth

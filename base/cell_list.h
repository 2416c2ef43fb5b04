// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trismooth {

/// VTK's cell types, as far as this project names them. A document may hold any other value.
namespace cell_type {
inline constexpr std::uint8_t vertex = 1;
inline constexpr std::uint8_t poly_vertex = 2;
inline constexpr std::uint8_t line = 3;
inline constexpr std::uint8_t poly_line = 4;
inline constexpr std::uint8_t triangle = 5;
inline constexpr std::uint8_t triangle_strip = 6;
inline constexpr std::uint8_t polygon = 7;
inline constexpr std::uint8_t quad = 9;
inline constexpr std::uint8_t tetrahedron = 10;
inline constexpr std::uint8_t hexahedron = 12;
inline constexpr std::uint8_t wedge = 13;
inline constexpr std::uint8_t pyramid = 14;
inline constexpr std::uint8_t quadratic_edge = 21;
inline constexpr std::uint8_t quadratic_triangle = 22;  ///< three corners, then the middles of 01, 12 and 20
inline constexpr std::uint8_t quadratic_quad = 23;
inline constexpr std::uint8_t quadratic_tetrahedron = 24;
inline constexpr std::uint8_t quadratic_hexahedron = 25;
inline constexpr std::uint8_t quadratic_wedge = 26;
inline constexpr std::uint8_t quadratic_pyramid = 27;
inline constexpr std::uint8_t biquadratic_quad = 28;
inline constexpr std::uint8_t triquadratic_hexahedron = 29;
inline constexpr std::uint8_t biquadratic_quadratic_wedge = 32;
inline constexpr std::uint8_t cubic_line = 35;
inline constexpr std::uint8_t convex_point_set = 41;
inline constexpr std::uint8_t lagrange_curve = 68;
inline constexpr std::uint8_t lagrange_triangle = 69;
inline constexpr std::uint8_t lagrange_quad = 70;
inline constexpr std::uint8_t lagrange_tetrahedron = 71;
inline constexpr std::uint8_t lagrange_hexahedron = 72;
inline constexpr std::uint8_t lagrange_wedge = 73;
inline constexpr std::uint8_t lagrange_pyramid = 74;

/// The type of a face of that many vertices, three or more.
constexpr std::uint8_t of_face(std::size_t vertices) {
  return vertices == 3 ? triangle : vertices == 4 ? quad : polygon;
}

/// 0 for points, 1 for lines and curves, 2 for faces, 3 for solids and for types that are not known.
constexpr int dimension(std::uint8_t type) {
  switch (type) {
    case vertex:
    case poly_vertex:
      return 0;
    case line:
    case poly_line:
    case quadratic_edge:
    case cubic_line:
    case lagrange_curve:
    case 75:  // Bezier curve
      return 1;
    case triangle:
    case triangle_strip:
    case polygon:
    case 8:  // pixel
    case quad:
    case quadratic_triangle:
    case quadratic_quad:
    case biquadratic_quad:
    case 30:  // quadratic linear quad
    case 34:  // biquadratic triangle
    case 36:  // quadratic polygon
    case lagrange_triangle:
    case lagrange_quad:
    case 76:  // Bezier triangle
    case 77:  // Bezier quad
      return 2;
    default:
      return 3;
  }
}
}  // namespace cell_type

/// The cells of a document, of any type and number of vertices, in the file's order.
struct CellList {
  std::vector<std::int64_t> offsets{0};    ///< cell c has connectivity[offsets[c] .. offsets[c + 1])
  std::vector<std::int32_t> connectivity;  ///< vertex indices from 0
  std::vector<std::uint8_t> types;         ///< one cell_type a cell

  /// Cells.
  [[nodiscard]] std::size_t size() const { return types.size(); }
  /// The vertices of a cell; valid until cells are appended.
  std::span<const std::int32_t> operator[](std::size_t cell) const {
    return std::span(connectivity)
        .subspan(static_cast<std::size_t>(offsets[cell]), static_cast<std::size_t>(offsets[cell + 1] - offsets[cell]));
  }
  /// Adds a cell behind the last. Constant time, but for growth.
  void append(std::uint8_t type, std::span<const std::int32_t> vertices) {
    connectivity.insert(connectivity.end(), vertices.begin(), vertices.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(type);
  }
};

}  // namespace trismooth

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

/// The type of a face of that many vertices, three or more.
constexpr std::uint8_t of_face(std::size_t vertices) {
  return vertices == 3 ? triangle : vertices == 4 ? quad : polygon;
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

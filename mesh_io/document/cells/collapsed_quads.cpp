// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/collapsed_quads.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "trismooth/mesh_io/document/cells/replaced_cells.h"

namespace trismooth {

namespace {

bool repeats_a_vertex(const std::array<std::int32_t, 3>& triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

/// Of four corners: that which is the next one as well, where the other three differ.
std::optional<std::size_t> repeated_corner(std::span<const std::int32_t> quad) {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::array three{quad[(i + 1) % 4], quad[(i + 2) % 4], quad[(i + 3) % 4]};
    if (quad[i] == three[0]) {
      return repeats_a_vertex(three) ? std::nullopt : std::optional(i);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<CollapsedQuad> triangle_of_quad(std::uint8_t type, std::span<const std::int32_t> vertices) {
  const bool is_straight = vertices.size() == 4 && (type == cell_type::quad || type == cell_type::polygon);
  if (!is_straight && !(vertices.size() == 8 && type == cell_type::quadratic_quad)) {
    return std::nullopt;
  }
  const std::optional<std::size_t> repeated = repeated_corner(vertices);
  if (!repeated) {
    return std::nullopt;
  }
  // One of the two is left out, and with it the side between them, whose middle is there as well.
  if (!is_straight && vertices[4 + *repeated] != vertices[*repeated]) {
    return std::nullopt;
  }
  CollapsedQuad triangle;
  std::array<std::int32_t, 3> middles{};
  const std::size_t left_out = std::min<std::size_t>(*repeated + 1, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.corners[i] = vertices[i < left_out ? i : i + 1];
    middles[i] = is_straight ? -1 : vertices[4 + (i < *repeated ? i : i + 1)];
  }
  if (!is_straight) {
    triangle.middles = middles;
  }
  return triangle;
}

std::size_t count_collapsed_quads(const MeshDocument& document) {
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    count += triangle_of_quad(document.cells.types[cell], document.cells[cell]) ? 1 : 0;
  }
  return count;
}

MeshDocument with_collapsed_quads_as_triangles(const MeshDocument& document) {
  return with_replaced_cells(document, [&document](std::size_t cell, CellList& cells) {
    const auto triangle = triangle_of_quad(document.cells.types[cell], document.cells[cell]);
    if (!triangle) {
      return false;
    }
    std::vector<std::int32_t> nodes(triangle->corners.begin(), triangle->corners.end());
    if (triangle->middles) {
      nodes.insert(nodes.end(), triangle->middles->begin(), triangle->middles->end());
    }
    cells.append(triangle->middles ? cell_type::quadratic_triangle : cell_type::triangle, nodes);
    return true;
  });
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/boundary_edges.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace trismooth {

namespace {

bool has_edges(std::uint8_t type) {
  return type == cell_type::triangle || type == cell_type::quad;
}

/// Calls visit(from, to, is_line) for every edge of triangles and quads and every line, in the order of the cells.
template <class Visit>
void for_edges(const CellList& cells, const Visit& visit) {
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const auto vertices = cells[cell];
    if (cells.types[cell] == cell_type::line) {
      visit(vertices[0], vertices[1], true);
    } else if (has_edges(cells.types[cell])) {
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        // A quadrilateral may repeat a corner: there it has no edge.
        if (const std::int32_t next = vertices[(i + 1) % vertices.size()]; next != vertices[i]) {
          visit(vertices[i], next, false);
        }
      }
    }
  }
}

/// An edge at its lower vertex.
struct EdgeEnd {
  std::int32_t other;  ///< the higher vertex
  bool is_line;
  std::size_t edge;  ///< its place among all
};

}  // namespace

std::vector<std::array<std::int32_t, 2>> find_boundary_edges(const CellList& cells) {
  const auto vertices = static_cast<std::size_t>(
      cells.connectivity.empty() ? 0 : *std::ranges::max_element(cells.connectivity) + std::int64_t{1});
  // The edges by their lower vertex: begins[v] to begins[v + 1].
  std::vector<std::size_t> begins(vertices + 2);
  for_edges(cells, [&begins](std::int32_t from, std::int32_t to, bool /*is_line*/) {
    ++begins[static_cast<std::size_t>(std::min(from, to)) + 2];
  });
  for (std::size_t v = 2; v < begins.size(); ++v) {
    begins[v] += begins[v - 1];
  }
  std::vector<EdgeEnd> ends(begins.back());
  std::size_t edge_count = 0;
  for_edges(cells, [&](std::int32_t from, std::int32_t to, bool is_line) {
    ends[begins[static_cast<std::size_t>(std::min(from, to)) + 1]++] = {std::max(from, to), is_line, edge_count++};
  });
  std::vector<bool> is_boundary(edge_count);
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::span<EdgeEnd> of_vertex = std::span(ends).subspan(begins[v], begins[v + 1] - begins[v]);
    std::ranges::sort(of_vertex, {}, &EdgeEnd::other);
    for (std::size_t first = 0; first < of_vertex.size();) {
      std::size_t last = first + 1;
      while (last < of_vertex.size() && of_vertex[last].other == of_vertex[first].other) {
        ++last;
      }
      is_boundary[of_vertex[first].edge] = last == first + 1 && !of_vertex[first].is_line;
      first = last;
    }
  }
  std::vector<std::array<std::int32_t, 2>> found;
  std::size_t edge = 0;
  for_edges(cells, [&](std::int32_t from, std::int32_t to, bool /*is_line*/) {
    if (is_boundary[edge++]) {
      found.push_back({from, to});
    }
  });
  return found;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/mesh_size.h"

#include <limits>
#include <stdexcept>

#include "trismooth/base/errors.h"

namespace trismooth {

void check_mesh_size(std::int64_t vertex_count, std::int64_t element_count, int corners) {
  const std::string elements = corners == 3 ? "triangles" : "elements";
  if (vertex_count < 0) {
    throw MeshError("the number of vertices is negative");
  }
  if (vertex_count > std::numeric_limits<std::int32_t>::max()) {
    throw MeshError("more than 2147483647 vertices");
  }
  if (element_count < 0) {
    throw MeshError("the number of " + elements + " is negative");
  }
  if (const std::int64_t most = std::numeric_limits<std::int32_t>::max() / corners; element_count > most) {
    throw MeshError("more than " + std::to_string(most) + " " + elements);
  }
}

void require_a_point_a_vertex(std::size_t points, std::size_t components, std::int64_t vertex_count) {
  const auto expected = static_cast<std::size_t>(vertex_count);
  if (points != expected) {
    const bool may_be_triples = components == 2 && 2 * points == 3 * expected;
    throw std::invalid_argument("points: " + std::to_string(points) + " of them, expected one for each of " +
                                std::to_string(expected) + " vertices" +
                                (may_be_triples ? "; xyz_points() is for x, y and z" : ""));
  }
}

std::string numbering_text(std::int64_t vertex_count) {
  return vertex_count == 0 ? ", and there are no vertices"
                           : "; vertices are numbered from 0 to " + std::to_string(vertex_count - 1);
}

std::string no_element_text(std::size_t element, std::size_t nodes) {
  return "element " + std::to_string(element) + " has " + std::to_string(nodes) +
         " nodes before the first -1: 3, 4, 6, 8 and 9 are possible, and nothing behind them";
}

void throw_no_such_vertex(std::int64_t element, const std::string& vertex, std::int64_t vertex_count,
                          std::string_view name) {
  throw MeshError(std::string(name) + " " + std::to_string(element) + " names vertex " + vertex +
                  numbering_text(vertex_count));
}

}  // namespace trismooth

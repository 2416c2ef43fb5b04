// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/boundary_edges.h"

#include <array>
#include <cstdint>
#include <vector>

#include "catch.h"

using trismooth::CellList;
using trismooth::find_boundary_edges;

namespace type = trismooth::cell_type;

namespace {

using Edges = std::vector<std::array<std::int32_t, 2>>;

void add(CellList& cells, std::uint8_t cell_type, const std::vector<std::int32_t>& vertices) {
  cells.append(cell_type, vertices);
}

}  // namespace

TEST_CASE("boundary edges: those of one triangle or quad, in the order and direction of the cells") {
  CellList cells;
  CHECK(find_boundary_edges(cells).empty());
  add(cells, type::triangle, {0, 1, 2});
  CHECK(find_boundary_edges(cells) == Edges{{0, 1}, {1, 2}, {2, 0}});
  // A quad beside it, and a triangle that lists the common edge the same way round.
  add(cells, type::quad, {2, 1, 5, 4});
  add(cells, type::triangle, {2, 0, 3});
  CHECK(find_boundary_edges(cells) == Edges{{0, 1}, {1, 5}, {5, 4}, {4, 2}, {0, 3}, {3, 2}});
}

TEST_CASE("boundary edges: lines take theirs, in either direction; edges of three cells are none") {
  CellList cells;
  add(cells, type::line, {1, 0});
  add(cells, type::triangle, {0, 1, 2});
  add(cells, type::line, {7, 6});
  CHECK(find_boundary_edges(cells) == Edges{{1, 2}, {2, 0}});
  add(cells, type::triangle, {1, 2, 3});
  add(cells, type::triangle, {1, 2, 4});
  CHECK(find_boundary_edges(cells) == Edges{{2, 0}, {2, 3}, {3, 1}, {2, 4}, {4, 1}});
}

TEST_CASE("boundary edges: none is from a vertex to itself where a quad repeats a corner") {
  CellList cells;
  add(cells, type::quad, {0, 1, 2, 2});
  add(cells, type::quad, {3, 0, 2, 3});
  CHECK(find_boundary_edges(cells) == Edges{{0, 1}, {1, 2}, {3, 0}, {2, 3}});
}

TEST_CASE("boundary edges: other cells have none") {
  CellList cells;
  add(cells, type::polygon, {0, 1, 2, 3, 4});
  add(cells, type::vertex, {2});
  add(cells, type::quadratic_triangle, {0, 1, 2, 3, 4, 5});
  CHECK(find_boundary_edges(cells).empty());
}

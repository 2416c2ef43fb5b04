// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <utility>
#include <vector>

#include "trismooth/pipeline/input/planar_mesh.h"

#include "catch.h"

namespace trismooth::middle_nodes_test {

using Bytes = std::vector<std::uint8_t>;
using Numbers = std::vector<std::int32_t>;

/// A square of two triangles of six nodes: corners 0 to 3, middles 4 to 8, of which 6 is in the diagonal; 9 is free to
/// be used.
MeshDocument square() {
  MeshDocument document;
  document.points = {0, 0,   0, 1,   0,   0, 1,   1, 0, 0, 1,   0, 0.5, 0, 0,
                     1, 0.5, 0, 0.5, 0.5, 0, 0.5, 1, 0, 0, 0.5, 0, 2,   2, 0};
  document.cells.append(cell_type::quadratic_triangle, Numbers{0, 1, 2, 4, 5, 6});
  document.cells.append(cell_type::quadratic_triangle, Numbers{0, 2, 3, 6, 7, 8});
  return document;
}

struct Settled {
  PlanarMesh mesh;
  Bytes named;
};

Settled settled(const MeshDocument& document, Bytes named = {}) {
  Settled result{planar_mesh(document, "mesh.vtu"), std::move(named)};
  settle_middles(result.mesh, document.points, result.named);
  return result;
}

TEST_CASE("triangles of six nodes are the triangles of their corners, and their middles follow the sides") {
  const MeshDocument document = square();
  const Settled result = settled(document);
  REQUIRE(result.mesh.elements.triangles().size() == 2);
  CHECK(result.mesh.elements.triangles()[1] == Triangle{0, 2, 3});
  CHECK(result.mesh.other_cells == 0);
  CHECK(result.mesh.notes.empty());
  REQUIRE(result.mesh.quadratics.size() == 2);
  REQUIRE(result.mesh.middles.size() == 5);
  CHECK(result.mesh.middles[2].vertex == 6);
  CHECK(result.mesh.middles[2].corners == std::array<std::int32_t, 4>{0, 2, no_corner, no_corner});
  CHECK(result.named.empty());
  CHECK(result.mesh.in_other_cell == Bytes{0, 0, 0, 0, 1, 1, 1, 1, 1, 0});
}

TEST_CASE("a middle that something else needs stays, and so do the ends of its sides") {
  SECTION("a line") {
    MeshDocument document = square();
    document.cells.append(cell_type::line, Numbers{5, 9});
    const Settled result = settled(document);
    CHECK(result.mesh.middles.size() == 4);
    CHECK(result.mesh.in_other_cell == Bytes{0, 1, 1, 0, 1, 1, 1, 1, 1, 1});
  }
  SECTION("a corner of a triangle, in whatever order they come") {
    for (const bool first : {false, true}) {
      MeshDocument document = square();
      const MeshDocument original = document;
      if (first) {
        document.cells = {};
        document.cells.append(cell_type::triangle, Numbers{5, 9, 1});
        document.cells.append(cell_type::quadratic_triangle, original.cells[0]);
        document.cells.append(cell_type::quadratic_triangle, original.cells[1]);
      } else {
        document.cells.append(cell_type::triangle, Numbers{5, 9, 1});
      }
      const Settled result = settled(document);
      CHECK(result.mesh.middles.size() == 4);
      CHECK(result.mesh.in_other_cell == Bytes{0, 1, 1, 0, 1, 1, 1, 1, 1, 0});
    }
  }
  SECTION("another side") {
    MeshDocument document = square();
    document.cells.connectivity[11] = 5;  // the middle of 30 is that of 12
    const Settled result = settled(document);
    CHECK(result.mesh.middles.size() == 3);
    CHECK(result.mesh.in_other_cell == Bytes{1, 1, 1, 1, 1, 1, 1, 1, 0, 0});
  }
  SECTION("a name") {
    const MeshDocument document = square();
    const Settled result = settled(document, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
    CHECK(result.mesh.middles.size() == 4);
    CHECK(result.named == Bytes{1, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    CHECK(result.mesh.in_other_cell == Bytes{0, 0, 0, 0, 1, 1, 1, 1, 1, 0});
  }
}

TEST_CASE(
    "a side that is shared with a plain triangle has a middle that follows, a quadratic line holds its vertices") {
  MeshDocument document = square();
  const MeshDocument original = document;
  document.cells = {};
  document.cells.append(cell_type::quadratic_triangle, original.cells[0]);
  document.cells.append(cell_type::triangle, Numbers{0, 2, 3});
  document.cells.append(cell_type::quadratic_edge, Numbers{0, 1, 4});
  const Settled result = settled(document);
  CHECK(result.mesh.elements.triangles().size() == 2);
  CHECK(result.mesh.middles.size() == 2);
  CHECK(result.mesh.in_other_cell == Bytes{1, 1, 0, 0, 1, 1, 1, 0, 0, 0});
}

/// A square of eight nodes beside one of nine; corners 0 to 5, middles 6 to 12, the centre 13.
MeshDocument two_squares() {
  MeshDocument document;
  document.points = {0,   0, 0, 1, 0,   0, 2, 0,   0, 0, 1,   0, 1,   1, 0, 2,   1, 0, 0.5, 0,   0,
                     1.5, 0, 0, 0, 0.5, 0, 1, 0.5, 0, 2, 0.5, 0, 0.5, 1, 0, 1.5, 1, 0, 1.5, 0.5, 0};
  document.cells.append(cell_type::quadratic_quad, Numbers{0, 1, 4, 3, 6, 9, 11, 8});
  document.cells.append(cell_type::biquadratic_quad, Numbers{1, 2, 5, 4, 7, 10, 12, 9, 13});
  return document;
}

TEST_CASE("quadrilaterals of eight and nine nodes are those of their corners, and middles and the centre follow") {
  const MeshDocument document = two_squares();
  const Settled result = settled(document);
  CHECK(result.mesh.count_quadrilaterals() == 2);
  CHECK(result.mesh.count_quadratic_quads() == 2);
  CHECK(result.mesh.other_cells == 0);
  CHECK(result.mesh.notes.empty());
  REQUIRE(result.mesh.middles.size() == 8);
  CHECK(result.mesh.middles.back().vertex == 13);
  CHECK(result.mesh.middles.back().corners == std::array<std::int32_t, 4>{1, 2, 5, 4});
  CHECK(result.mesh.in_other_cell == Bytes{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1});
}

TEST_CASE("a centre that something else needs stays, and so do the corners around it") {
  for (const bool is_named : {false, true}) {
    MeshDocument document = two_squares();
    if (!is_named) {
      document.cells.append(cell_type::vertex, Numbers{13});
    }
    const Settled result = settled(document, is_named ? Bytes{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1} : Bytes{});
    CHECK(result.mesh.middles.size() == 7);
    CHECK((is_named ? result.named : result.mesh.in_other_cell)[1] == 1);
    for (const std::size_t corner : {1U, 2U, 4U, 5U}) {
      CHECK((is_named ? result.named : result.mesh.in_other_cell)[corner] == 1);
    }
    CHECK((is_named ? result.named : result.mesh.in_other_cell)[0] == 0);
  }
}

TEST_CASE("a triangle of six nodes that repeats a corner is kept as another cell") {
  MeshDocument document = square();
  document.cells.append(cell_type::quadratic_triangle, Numbers{0, 0, 1, 4, 4, 9});
  const Settled result = settled(document);
  CHECK(result.mesh.other_cells == 1);
  CHECK(result.mesh.quadratics.size() == 2);
  CHECK(result.mesh.in_other_cell == Bytes{1, 1, 0, 0, 1, 1, 1, 1, 1, 1});
}

}  // namespace trismooth::middle_nodes_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/planar_mesh.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "mesh_io/byte_files.h"
#include "support/scratch_folder.h"

namespace trismooth::planar_mesh_test {

using byte_files::contains;

using Bytes = std::vector<std::uint8_t>;
using Numbers = std::vector<std::int32_t>;

struct Cell {
  std::uint8_t type;
  Numbers vertices;
};

/// Points (0, 0), (1, 0), (2, 0) and above them (0, 1), (1, 1), (2, 1), with cells over them.
MeshDocument document_of(const std::vector<Cell>& cells) {
  MeshDocument document;
  document.points = {0, 0, 5, 1, 0, 5, 2, 0, 5, 0, 1, 5, 1, 1, 5, 2, 1, 5};
  for (const Cell& cell : cells) {
    document.cells.append(cell.type, cell.vertices);
  }
  return document;
}

/// Both squares cut into triangles, with a line among them.
MeshDocument two_squares() {
  return document_of({{cell_type::triangle, {0, 1, 4}},
                      {cell_type::triangle, {0, 4, 3}},
                      {cell_type::line, {1, 4}},
                      {cell_type::triangle, {1, 2, 5}},
                      {cell_type::triangle, {1, 5, 4}}});
}

std::vector<Triangle> listed(const PlanarMesh& mesh) {
  return {mesh.elements.triangles().begin(), mesh.elements.triangles().end()};
}

std::string failure_of(const MeshDocument& document) {
  return message_of<ReadError>([&] { planar_mesh(document, "mesh.vtu"); });
}

TEST_CASE("triangles keep their order, their vertices' order and know their cell") {
  const MeshDocument document = two_squares();
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  CHECK(listed(mesh) == std::vector<Triangle>{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
  CHECK(mesh.cells == Numbers{0, 1, 3, 4});
  CHECK(mesh.plane.aligned);
  REQUIRE(mesh.points.size() == 6);
  CHECK(mesh.points[5] == trismooth::Point2<double>{2, 1});
}

TEST_CASE("polygons of three vertices are triangles") {
  const MeshDocument document = document_of({{cell_type::polygon, {0, 1, 4}}, {cell_type::polygon, {4, 3, 0}}});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtp");
  CHECK(listed(mesh) == std::vector<Triangle>{{0, 1, 4}, {4, 3, 0}});
  CHECK(mesh.other_cells == 0);
  CHECK(mesh.in_other_cell == Bytes(6, 0));
  CHECK(mesh.notes.empty());
}

TEST_CASE("the vertices of every cell that is no element are held, and a note says so") {
  struct Case {
    Cell cell;
    Bytes held;
  };
  const std::vector<Case> cases{{{cell_type::quad, {1, 2, 5, 4}}, {0, 1, 1, 0, 1, 1}},
                                {{cell_type::polygon, {1, 2, 5, 4}}, {0, 1, 1, 0, 1, 1}},
                                {{cell_type::line, {1, 4}}, {0, 1, 0, 0, 1, 0}},
                                {{cell_type::poly_line, {0, 1, 2}}, {1, 1, 1, 0, 0, 0}},
                                {{cell_type::vertex, {5}}, {0, 0, 0, 0, 0, 1}},
                                {{cell_type::poly_vertex, {3, 4, 5}}, {0, 0, 0, 1, 1, 1}},
                                {{cell_type::triangle_strip, {1, 2, 2, 1}}, {0, 1, 1, 0, 0, 0}},
                                {{30, {0, 1, 4, 2, 3, 5}}, {1, 1, 1, 1, 1, 1}},
                                {{0, {}}, {0, 0, 0, 0, 0, 0}}};
  for (const Case& c : cases) {
    CAPTURE(static_cast<int>(c.cell.type));
    const MeshDocument document = document_of({c.cell, {cell_type::triangle, {0, 1, 4}}});
    const PlanarMesh mesh = planar_mesh(document, "mesh.vtu", trismooth::Quads::hold);
    CHECK(listed(mesh) == std::vector<Triangle>{{0, 1, 4}});
    CHECK(mesh.cells == Numbers{1});
    CHECK(mesh.other_cells == 1);
    CHECK(mesh.in_other_cell == c.held);
    // (Of quadrilaterals of more nodes than four another one does.)
    REQUIRE(mesh.notes.size() == (c.cell.type == 30 ? 2 : 1));
    const bool is_line = cell_type::dimension(c.cell.type) == 1;
    CHECK(mesh.lines == (is_line ? 1 : 0));
    CHECK(contains(mesh.notes[0], is_line ? "1 line: not smoothed" : "1 cell of other types than triangle"));
  }
}

TEST_CASE("a triangle that repeats a vertex is held as another cell, and a note names the first") {
  for (const Numbers& vertices : {Numbers{1, 1, 2}, Numbers{1, 2, 2}, Numbers{2, 1, 2}, Numbers{1, 1, 1}}) {
    CAPTURE(vertices);
    const MeshDocument document = document_of(
        {{cell_type::triangle, {0, 1, 4}}, {cell_type::triangle, vertices}, {cell_type::triangle, vertices}});
    const PlanarMesh mesh = planar_mesh(document, "mesh.off");
    CHECK(mesh.elements.triangles().size() == 1);
    CHECK(mesh.other_cells == 2);
    CHECK(mesh.in_other_cell[1] == 1);
    CHECK(mesh.in_other_cell[0] == 0);
    REQUIRE(mesh.notes.size() == 1);
    CHECK(contains(mesh.notes[0], "2 triangles repeating a vertex"));
    CHECK(contains(mesh.notes[0], "cell 1"));
  }
}

TEST_CASE("cells without any element are refused") {
  const std::string message =
      failure_of(document_of({{cell_type::polygon, {0, 1, 2, 4, 3}}, {cell_type::line, {0, 1}}}));
  CHECK(message.find("mesh.vtu: ") == 0);
  CHECK(contains(message, "2 cells but no triangle"));
  CHECK(contains(failure_of(document_of({{cell_type::triangle, {0, 1, 1}}})), "1 cell but no triangle"));
}

TEST_CASE("a mesh of solids is refused as one, with the faces of its surface or without any") {
  const Cell tetrahedron{cell_type::tetrahedron, {0, 1, 3, 6}};
  const Cell hexahedron{cell_type::hexahedron, {0, 1, 4, 3, 6, 7, 8, 9}};
  const auto refusal = [](const std::vector<Cell>& cells) {
    MeshDocument document = document_of(cells);
    document.points.insert(document.points.end(), {0, 0, 6, 1, 0, 6, 1, 1, 6, 0, 1, 6});
    return failure_of(document);
  };
  const std::string why = ": a mesh of solids is not smoothed, only plane meshes of triangles and quadrilaterals are";
  CHECK(refusal({tetrahedron}) == "mesh.vtu: holds 1 tetrahedron" + why);
  CHECK(refusal({{cell_type::triangle, {0, 1, 4}}, hexahedron, tetrahedron, hexahedron}) ==
        "mesh.vtu: holds 1 tetrahedron, 2 hexahedra" + why);
  CHECK(refusal({tetrahedron, {cell_type::wedge, {0, 1, 3, 6, 7, 9}}}) ==
        "mesh.vtu: holds 1 tetrahedron, 1 other solid cell" + why);
  CHECK(refusal({{cell_type::wedge, {0, 1, 3, 6, 7, 9}}}) == "mesh.vtu: holds 1 solid cell" + why);
  // A surface, which has none, and a cell of no type that is known.
  CHECK(contains(refusal({{cell_type::triangle, {0, 1, 4}}, {cell_type::triangle, {0, 1, 8}}}), "is not planar"));
  CHECK(contains(refusal({{0, {0}}}), "1 cell but no triangle"));
}

TEST_CASE("a document without cells is fine: there is nothing to smooth") {
  for (const MeshDocument& document : {document_of({}), MeshDocument{}}) {
    const PlanarMesh mesh = planar_mesh(document, "mesh.off");
    CHECK(mesh.elements.triangles().empty());
    CHECK(mesh.points.size() == document.point_count());
    REQUIRE(mesh.notes.size() == 1);
    CHECK(contains(mesh.notes[0], "nothing to smooth"));
  }
}

TEST_CASE("a mesh that is not planar is refused") {
  MeshDocument document = two_squares();
  document.points[2] = 5 + 1e-6;
  CHECK_NOTHROW(planar_mesh(document, "mesh.vtu"));
  document.points[2] = 5.5;
  const std::string message = failure_of(document);
  CHECK(message.find("mesh.vtu: ") == 0);
  CHECK(contains(message, "not planar"));
}

TEST_CASE("a mesh whose coordinates along its tilted plane no double can hold is refused") {
  MeshDocument document = document_of({{cell_type::triangle, {0, 2, 3}}});
  for (std::size_t i = 0; i < document.points.size(); i += 3) {
    const double x = 1.5e308 * (document.points[i] - 1);
    document.points[i] = x;
    document.points[i + 1] *= 1.5e308;
    document.points[i + 2] = x;
  }
  CHECK(contains(message_of<ReadError>([&] { planar_mesh(document, "mesh.off"); }), "mesh.off: the mesh is too large"));
  for (double& coordinate : document.points) {
    coordinate /= 4;
  }
  CHECK(std::isfinite(planar_mesh(document, "mesh.off").points[0].x));
}

TEST_CASE("documents of more points or cells than 32 bits number are refused by name") {
  constexpr std::size_t most = 2147483647;
  CHECK_NOTHROW(trismooth::check_document_size(most, most, "large.vtu"));
  CHECK(message_of<ReadError>([&] { trismooth::check_document_size(most + 1, 1, "large.vtu"); }) ==
        "large.vtu: holds more than 2147483647 vertices");
  CHECK(message_of<ReadError>([&] { trismooth::check_document_size(1, std::size_t{1} << 33U, "large.vtu"); }) ==
        "large.vtu: holds more than 2147483647 cells");
}

}  // namespace trismooth::planar_mesh_test

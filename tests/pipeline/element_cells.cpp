// SPDX-License-Identifier: BSD-3-Clause
// Cells of other types that are triangles, as real programs write them.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/slide_lines.h"

#include "catch.h"
#include "mesh_io/byte_files.h"
#include "support/scratch_folder.h"

namespace trismooth::element_cells_test {

using byte_files::contains;

struct Cell {
  std::uint8_t type;
  std::vector<std::int32_t> vertices;
};

/// Points i, j of the grid of 5 x 5 from (0, 0) to (4, 4), by number i + 5 j, with cells over them.
MeshDocument document_of(const std::vector<Cell>& cells) {
  MeshDocument document;
  for (int v = 0; v < 25; ++v) {
    const int row = v / 5;
    document.points.insert(document.points.end(), {static_cast<double>(v % 5), static_cast<double>(row), 0});
  }
  for (const Cell& cell : cells) {
    document.cells.append(cell.type, cell.vertices);
  }
  return document;
}

std::vector<Triangle> listed(const PlanarMesh& mesh) {
  return {mesh.elements.triangles().begin(), mesh.elements.triangles().end()};
}

TEST_CASE("VTK's Lagrange triangles of order 1 and 2 are triangles of three and six nodes, beside ordinary ones") {
  const MeshDocument document = document_of({{cell_type::lagrange_triangle, {0, 2, 12}},
                                             {cell_type::triangle, {0, 12, 10}},
                                             {cell_type::lagrange_triangle, {2, 4, 14, 3, 9, 8}}});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  CHECK(listed(mesh) == std::vector<Triangle>{{0, 2, 12}, {0, 12, 10}, {2, 4, 14}});
  CHECK(mesh.other_cells == 0);
  REQUIRE(mesh.quadratics.size() == 1);
}

TEST_CASE("VTK's Lagrange curves of order 1 are lines that vertices may slide on, those of higher order are none") {
  const MeshDocument document = document_of({{cell_type::triangle, {0, 2, 12}},
                                             {cell_type::triangle, {0, 12, 10}},
                                             {cell_type::lagrange_curve, {0, 2}},
                                             {cell_type::lagrange_curve, {12, 10, 11}}});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  const trismooth::SlideLines found = find_slide_lines(document, mesh, {});
  CHECK(found.lines == std::vector<std::int32_t>{0, 2});
  CHECK(found.in_other_cell[2] == 0);
  CHECK(found.in_other_cell[10] == 1);
}

TEST_CASE("triangles of more nodes are not taken for triangles, and named") {
  const MeshDocument document = document_of(
      {{cell_type::triangle, {0, 2, 12}}, {cell_type::lagrange_triangle, {2, 4, 14, 3, 9, 8, 7, 13, 1, 6}}});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  CHECK(listed(mesh) == std::vector<Triangle>{{0, 2, 12}});
  CHECK(mesh.other_cells == 1);
  std::string notes;
  for (const std::string& note : mesh.notes) {
    notes += note + "\n";
  }
  CHECK(contains(notes, "cubic triangles"));
  const auto only_cubic = [] {
    const MeshDocument cubic = document_of({{cell_type::lagrange_triangle, {2, 4, 14, 3, 9, 8, 7, 13, 1, 6}}});
    planar_mesh(cubic, "mesh.vtu");
  };
  CHECK(contains(message_of<trismooth::ReadError>(only_cubic), "cubic triangles"));
}

TEST_CASE("quadrilaterals that repeat a corner are the triangles that they look like, wherever the corner is") {
  const MeshDocument document = document_of({{cell_type::quad, {0, 2, 12, 12}},
                                             {cell_type::quad, {0, 12, 10, 0}},
                                             {cell_type::quad, {2, 2, 4, 14}},
                                             {cell_type::quad, {2, 14, 12, 13}}});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu", trismooth::Quads::hold);
  REQUIRE(mesh.elements.triangles().size() == 3);
  const std::vector<Triangle> expected{{0, 2, 12}, {0, 12, 10}, {2, 4, 14}};
  for (std::size_t t = 0; t < 3; ++t) {
    std::vector<std::int32_t> corners(mesh.elements.triangles()[t].begin(), mesh.elements.triangles()[t].end());
    const auto first = std::ranges::find(corners, expected[t][0]);
    std::rotate(corners.begin(), first, corners.end());
    CHECK(corners == std::vector<std::int32_t>(expected[t].begin(), expected[t].end()));
  }
  CHECK(mesh.other_cells == 1);
  std::string notes;
  for (const std::string& note : mesh.notes) {
    notes += note + "\n";
  }
  CHECK(contains(notes, "3 quadrilaterals repeat a corner"));
}

}  // namespace trismooth::element_cells_test

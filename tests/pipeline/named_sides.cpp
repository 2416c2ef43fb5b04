// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/named_sides.h"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/input/slide_lines.h"

#include "catch.h"

namespace trismooth::named_sides_test {

using Numbers = std::vector<std::int32_t>;

/// A square of four triangles around a vertex in the middle, and a line beside it.
MeshDocument fan() {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.4, 0.6, 0, 3, 0, 0, 4, 0, 0};
  for (const Numbers& cell : {Numbers{0, 1, 4}, {5, 6}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}) {
    document.cells.append(cell.size() == 2 ? cell_type::line : cell_type::triangle, cell);
  }
  return document;
}

template <class T>
void add(MeshDocument& document, const std::string& name, std::vector<T> values) {
  document.cell_arrays.push_back(make_data_array(name, 1, std::move(values)));
}

NamedSides sides_of(const MeshDocument& document) {
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  return find_named_sides(document, mesh);
}

TEST_CASE("the bits of a cell are the sides 01, 12 and 02 of its triangle, each named once") {
  MeshDocument document = fan();
  add<std::int64_t>(document, "skfem:b:spoke", {2, 7, 4, 0, 0});  // twice the side 1-4
  add<std::int32_t>(document, "skfem:b:low", {1, 0, 0, 0, 0});
  const NamedSides sides = sides_of(document);
  CHECK(sides.lines == Numbers{0, 1, 1, 4});
  REQUIRE(sides.tags.size() == 2);
  CHECK(sides.tags[0] != sides.tags[1]);
  CHECK(sides.names == "'skfem:b:spoke', 'skfem:b:low'");
}

TEST_CASE("what is no set of bits marks nothing") {
  for (const double value : {0.0, -1.0, 8.0, 1.5, 1e300, -1e300, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    MeshDocument document = fan();
    add<double>(document, "skfem:b:wall", std::vector<double>(5, value));
    CHECK(sides_of(document).count() == 0);
  }
}

TEST_CASE("a named boundary inside the mesh holds its vertices, says so, and is no region") {
  MeshDocument document = fan();
  add<std::int32_t>(document, "skfem:b:crack", {2, 0, 0, 0, 0});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  CHECK(mesh.in_other_cell == std::vector<std::uint8_t>{0, 1, 0, 0, 1, 1, 1});
  REQUIRE(mesh.notes.size() == 2);
  CHECK(mesh.notes[1] ==
        "named boundaries on sides of elements ('skfem:b:crack'; 1 side): their vertices are held, or slide along "
        "them with --slide");
  const trismooth::Regions regions = find_regions(document, mesh);
  CHECK(regions.arrays.empty());
  CHECK(regions.notes.empty());
}

TEST_CASE("named subdomains are regions of known names") {
  MeshDocument document = fan();
  add<std::int32_t>(document, "skfem:s:left", {0, 0, 1, 1, 0});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  const trismooth::Regions regions = find_regions(document, mesh);
  REQUIRE(regions.arrays.size() == 1);
  CHECK(regions.arrays[0].reason == trismooth::RegionReason::known_name);
  CHECK(regions.notes.empty());
}

TEST_CASE("where vertices slide named boundaries are lines, told apart from each other and from line cells") {
  MeshDocument document = fan();
  add<std::int32_t>(document, "skfem:b:low", {3, 0, 0, 0, 0});
  add<std::int32_t>(document, "skfem:b:spoke", {2, 0, 0, 0, 0});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  const trismooth::SlideLines lines = find_slide_lines(document, mesh, {});
  CHECK(lines.lines == Numbers{5, 6, 0, 1, 1, 4});
  REQUIRE(lines.tags.size() == 3);
  CHECK(lines.tags[0] != lines.tags[1]);
  CHECK(lines.tags[1] != lines.tags[2]);
  CHECK(lines.tags[2] != lines.tags[0]);
  CHECK(lines.in_other_cell == std::vector<std::uint8_t>(7, 0));
}

}  // namespace trismooth::named_sides_test

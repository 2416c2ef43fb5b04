// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/strip_triangles.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::FileFormat;
using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::planar_mesh;
using trismooth::PlanarMesh;
using trismooth::Triangle;

namespace cell_type = trismooth::cell_type;

namespace {

using Numbers = std::vector<std::int32_t>;

/// Two rows of points, the even ones below: 0, 2, 4, ... and above them 1, 3, 5, ...
MeshDocument two_rows(int points) {
  MeshDocument document;
  for (int i = 0; i < points; ++i) {
    document.points.insert(document.points.end(), {std::floor(i / 2.0), double(i % 2), 0.0});
  }
  return document;
}

double doubled_area(const PlanarMesh& mesh, const Triangle& triangle) {
  const auto at = [&](std::size_t corner) { return mesh.points[static_cast<std::size_t>(triangle.at(corner))]; };
  return (at(1).x - at(0).x) * (at(2).y - at(0).y) - (at(2).x - at(0).x) * (at(1).y - at(0).y);
}

}  // namespace

TEST_CASE("a triangle strip counts as its triangles, which turn the same way and know their cell") {
  MeshDocument document = two_rows(8);
  document.cells.append(cell_type::line, Numbers{0, 2});
  document.cells.append(cell_type::triangle_strip, Numbers{0, 1, 2, 3, 4, 5});
  document.cells.append(cell_type::triangle, Numbers{4, 5, 6});
  document.cells.append(cell_type::triangle_strip, Numbers{6, 5, 7});
  const PlanarMesh mesh = planar_mesh(document, "strips.vtk");
  CHECK(mesh.elements.triangles().size() == 6U);
  CHECK(mesh.cells == Numbers{1, 1, 1, 1, 2, 3});
  CHECK(mesh.other_cells == 1);
  CHECK(std::ranges::count(mesh.in_other_cell, 1) == 2);
  for (const Triangle& triangle : mesh.elements.triangles()) {
    CHECK(doubled_area(mesh, triangle) == -1.0);
  }
  std::vector<std::vector<std::int32_t>> corners;
  for (Triangle triangle : mesh.elements.triangles()) {
    std::ranges::sort(triangle);
    corners.emplace_back(triangle.begin(), triangle.end());
  }
  CHECK(corners == std::vector<Numbers>{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 5}, {4, 5, 6}, {5, 6, 7}});
}

TEST_CASE("triangles that join two parts of a strip are none, and hold no vertex") {
  MeshDocument document = two_rows(8);
  document.cells.append(cell_type::triangle_strip, Numbers{0, 1, 2, 3, 3, 4, 4, 5, 6, 7});
  const PlanarMesh mesh = planar_mesh(document, "strips.vtk");
  CHECK(mesh.elements.triangles().size() == 4U);
  CHECK(mesh.other_cells == 0);
  CHECK(std::ranges::count(mesh.in_other_cell, 1) == 0);
  for (const Triangle& triangle : mesh.elements.triangles()) {
    CHECK(doubled_area(mesh, triangle) == -1.0);
  }
}

TEST_CASE("a strip without any triangle is another cell, and alone no mesh") {
  MeshDocument document = two_rows(6);
  document.cells.append(cell_type::triangle_strip, Numbers{0, 1, 1, 0, 0});
  CHECK_THROWS_AS(planar_mesh(document, "strips.vtk"), trismooth::ReadError);
  document.cells.append(cell_type::triangle, Numbers{3, 4, 5});
  const PlanarMesh mesh = planar_mesh(document, "strips.vtk");
  CHECK(mesh.elements.triangles().size() == 1U);
  CHECK(mesh.other_cells == 1);
  CHECK(mesh.in_other_cell == std::vector<std::uint8_t>{1, 1, 0, 0, 0, 0});
}

TEST_CASE("the triangles of a strip are of the region of their cell") {
  MeshDocument document = two_rows(8);
  document.cells.append(cell_type::triangle_strip, Numbers{0, 1, 2, 3});
  document.cells.append(cell_type::triangle_strip, Numbers{2, 3, 4, 5});
  document.cells.append(cell_type::triangle_strip, Numbers{4, 5, 6, 7});
  document.cell_arrays = {make_data_array("region", 1, Numbers{7, 7, 9})};
  const PlanarMesh mesh = planar_mesh(document, "strips.vtk");
  CHECK(trismooth::find_regions(document, mesh).of_triangle == Numbers{0, 0, 0, 0, 1, 1});
}

TEST_CASE("formats without strips get their triangles, with the arrays' rows, and a note says so") {
  const ScratchFolder folder;
  MeshDocument document = two_rows(6);
  document.cells.append(cell_type::triangle, Numbers{4, 3, 5});
  document.cells.append(cell_type::triangle_strip, Numbers{0, 1, 2, 3, 3, 4});
  document.cell_arrays = {make_data_array("part", 2, Numbers{10, 11, 20, 21})};
  const PlanarMesh mesh = planar_mesh(document, "strips.vtk");
  for (const FileFormat format : trismooth::all_formats()) {
    const std::string name(to_string(format));
    CAPTURE(name);
    const std::string file = "out" + std::string(extensions_of(format).front());
    write_mesh(folder / file, document);
    const MeshDocument again = trismooth::read_mesh(folder / file);
    const PlanarMesh converted = planar_mesh(again, "out");
    CHECK(converted.elements.triangles().size() == mesh.elements.triangles().size());
    const bool holds_strips = name.starts_with("vt");
    CHECK(has_strips(again) == holds_strips);
    const std::vector<std::string> lost = what_is_lost(document, format);
    const std::string sentence = trismooth::upper_case(name) + " holds no triangle strips: 1 is written as 2 triangles";
    const bool told = std::ranges::any_of(lost, [&](const std::string& said) { return said.starts_with(sentence); });
    CHECK(told == !holds_strips);
    if (format == FileFormat::ply) {
      REQUIRE(again.cell_arrays.size() == 2U);
      for (std::size_t component = 0; component < 2; ++component) {
        CHECK(std::ranges::equal(again.cell_arrays[component].as<std::int32_t>(),
                                 component == 0 ? Numbers{10, 20, 20} : Numbers{11, 21, 21}));
      }
    }
  }
}

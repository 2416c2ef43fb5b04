// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/straight_cells.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/collapsed_quads.h"
#include "trismooth/mesh_io/document/cells/halved_quads.h"
#include "trismooth/mesh_io/document/cells/lagrange_cells.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/text_format.h"

using trismooth::FileFormat;
using trismooth::find_array;
using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::NamedSet;
using trismooth::what_is_lost;

namespace cell_type = trismooth::cell_type;

namespace {

/// A square of two triangles of six nodes, an edge of three at its bottom, and a straight line at one of its middles.
/// Points 0 to 3 are corners.
MeshDocument square() {
  MeshDocument document;
  document.points = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 1, 0, 9, 9, 0};
  document.cells.append(cell_type::quadratic_triangle, std::vector<std::int32_t>{0, 1, 2, 4, 5, 6});
  document.cells.append(cell_type::quadratic_triangle, std::vector<std::int32_t>{0, 2, 3, 6, 7, 8});
  document.cells.append(cell_type::quadratic_edge, std::vector<std::int32_t>{0, 1, 4});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{7, 3});
  document.point_arrays.push_back(
      make_data_array("depth", 1, std::vector<double>{0, 10, 20, 30, 40, 50, 60, 70, 80, 90}));
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<std::int32_t>{1, 2, 3, 3}));
  document.point_sets = {{"some", {1, 5, 7}}, {"middles", {4, 6}}};
  return document;
}

}  // namespace

TEST_CASE("curved cells become those of their corners, without the points in the middle of their sides alone") {
  const MeshDocument straight = with_straight_cells(square());
  CHECK(straight.cells.types ==
        std::vector<std::uint8_t>{cell_type::triangle, cell_type::triangle, cell_type::line, cell_type::line});
  // Point 7 is that of a line too, and 9 was of no cell before.
  CHECK(straight.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 0, 1, 4, 3});
  CHECK(straight.points == std::vector<double>{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 2, 0, 9, 9, 0});
  const auto depths = find_array(straight.point_arrays, "depth")->as<double>();
  CHECK(std::vector<double>(depths.begin(), depths.end()) == std::vector<double>{0, 10, 20, 30, 70, 90});
  CHECK(straight.point_sets == std::vector<NamedSet>{{"some", {1, 4}}, {"middles", {}}});
  CHECK(find_array(straight.cell_arrays, "region")->rows() == 4);
}

TEST_CASE("quadrilaterals of eight and nine nodes become those of four, and straight meshes stay as they are") {
  MeshDocument document;
  document.points.resize(27);
  document.cells.append(cell_type::quadratic_quad, std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7});
  document.cells.append(cell_type::biquadratic_quad, std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(has_curved_cells(document));
  const MeshDocument straight = with_straight_cells(document);
  CHECK(straight.cells.types == std::vector<std::uint8_t>{cell_type::quad, cell_type::quad});
  CHECK(straight.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 3, 0, 1, 2, 3});
  CHECK(straight.point_count() == 4);
  CHECK_FALSE(has_curved_cells(straight));
}

TEST_CASE("formats that hold straight cells only get the triangles of a curved mesh, and a note says so") {
  for (const trismooth::Codec* const codec : trismooth::all_codecs) {
    if (codec->partner_of != nullptr || codec->other_files_of != nullptr) {
      continue;  // meshes of several files
    }
    const trismooth::FormatDescription& format = codec->description;
    CAPTURE(format.title);
    const TextFormat text{std::string(format.extensions.front())};
    MeshDocument curved = square();
    curved.format = format.format;
    const MeshDocument read = text.read(text.written(curved));
    CHECK(std::ranges::count(read.cells.types,
                             format.holds.curved_cells ? cell_type::quadratic_triangle : cell_type::triangle) == 2);
    if (!format.holds.curved_cells) {
      CHECK(what_is_lost(curved, format.format).front() ==
            std::string(format.title) +
                " holds straight cells only: 3 curved ones are written by their corners, without 4 points in the "
                "middle of sides");
    }
  }
}

TEST_CASE(
    "Medit gets the corners of quadrilaterals of eight nodes, beside curved cells that it holds, and a note says so") {
  // A triangle of six nodes shares a side and its middle, 7, with a quadrilateral of eight; one of nine is beside both.
  MeshDocument document;
  document.format = FileFormat::medit;
  for (int i = 0; i < 19; ++i) {
    const int row = i / 5;
    document.points.insert(document.points.end(), {double(i % 5), double(row), 0});
  }
  document.cells.append(cell_type::quadratic_quad, std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7});
  document.cells.append(cell_type::quadratic_triangle, std::vector<std::int32_t>{0, 3, 8, 7, 9, 10});
  document.cells.append(cell_type::biquadratic_quad, std::vector<std::int32_t>{11, 12, 2, 1, 14, 15, 5, 16, 17});
  CHECK(what_is_lost(document, FileFormat::medit).front() ==
        "Medit holds no quadrilaterals of eight nodes: 1 one is written by their corners, without 2 points in the "
        "middle of "
        "sides");
  const TextFormat text{".mesh"};
  const MeshDocument read = text.read(text.written(document));
  CHECK(std::ranges::count(read.cells.types, cell_type::quad) == 1);
  CHECK(std::ranges::count(read.cells.types, cell_type::quadratic_triangle) == 1);
  CHECK(std::ranges::count(read.cells.types, cell_type::biquadratic_quad) == 1);
  CHECK(read.point_count() == document.point_count() - 2);
}

TEST_CASE("VTK's Lagrange cells of order 1 and 2 are written to other formats as the ordinary ones that they are") {
  struct Pair {
    std::uint8_t ordinary;
    std::uint8_t lagrange;
    std::vector<std::int32_t> vertices;
  };
  MeshDocument ordinary;
  MeshDocument lagrange;
  for (int point = 0; point < 16; ++point) {
    const int row = point / 4;
    ordinary.points.insert(ordinary.points.end(), {point % 4 + 0.5, row - 0.25, 0});
  }
  lagrange.points = ordinary.points;
  for (const Pair& cell : {Pair{cell_type::triangle, cell_type::lagrange_triangle, {0, 1, 4}},
                           {cell_type::quad, cell_type::lagrange_quad, {1, 2, 6, 5}},
                           {cell_type::quadratic_triangle, cell_type::lagrange_triangle, {4, 6, 12, 5, 9, 8}},
                           {cell_type::biquadratic_quad, cell_type::lagrange_quad, {5, 7, 15, 13, 6, 11, 14, 9, 10}},
                           {cell_type::line, cell_type::lagrange_curve, {0, 1}},
                           {cell_type::quadratic_edge, cell_type::lagrange_curve, {4, 6, 5}}}) {
    ordinary.cells.append(cell.ordinary, cell.vertices);
    lagrange.cells.append(cell.lagrange, cell.vertices);
  }
  for (const FileFormat format : trismooth::all_formats()) {
    const trismooth::Codec& codec = trismooth::codec_of(format);
    if (codec.description.holds.cells_of_any_order || codec.partner_of != nullptr || codec.other_files_of != nullptr ||
        format == FileFormat::vtp) {
      continue;  // of several files, or VTK's own
    }
    CAPTURE(title_of(format));
    ordinary.format = lagrange.format = format;
    const TextFormat text{std::string(extensions_of(format).front())};
    CHECK(text.written(lagrange) == text.written(ordinary));
    CHECK(what_is_lost(lagrange, format) == what_is_lost(ordinary, format));
  }
  // VTK's own formats have them.
  for (const FileFormat format : {FileFormat::vtk, FileFormat::vtu}) {
    if (is_available(format)) {
      const TextFormat text{std::string(extensions_of(format).front())};
      CHECK(text.read(text.written(lagrange)).cells.types == lagrange.cells.types);
    }
  }
}

TEST_CASE("formats that hold triangles only get those that quadrilaterals and polygons are, and a note says so") {
  MeshDocument triangles;
  triangles.points = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 0, 0, 2, 1, 0, 1, 1, 0};
  MeshDocument quads;
  quads.points = triangles.points;
  MeshDocument polygons = quads;
  const auto add = [](MeshDocument& document, std::uint8_t type, const std::vector<std::int32_t>& vertices) {
    document.cells.append(type, vertices);
  };
  for (const std::vector<std::int32_t>& corners : {std::vector{0, 4, 6}, std::vector{4, 1, 5}, std::vector{6, 2, 3}}) {
    add(triangles, cell_type::triangle, corners);
    add(polygons, cell_type::polygon, corners);
  }
  add(quads, cell_type::quad, {0, 4, 6, 6});
  add(quads, cell_type::polygon, {4, 1, 1, 5});
  add(quads, cell_type::quad, {6, 2, 3, 6});
  for (const FileFormat format :
       {FileFormat::stl, FileFormat::adcirc, FileFormat::freefem, FileFormat::su2, FileFormat::inp, FileFormat::msh}) {
    CAPTURE(title_of(format));
    triangles.format = quads.format = polygons.format = format;
    const TextFormat text{std::string(extensions_of(format).front())};
    CHECK(text.written(polygons) == text.written(triangles));
    CHECK(what_is_lost(polygons, format) == what_is_lost(triangles, format));
    if (format == FileFormat::su2 || format == FileFormat::inp || format == FileFormat::msh) {
      const MeshDocument read = text.read(text.written(quads));
      CHECK(std::ranges::count(read.cells.types, cell_type::quad) == 3);
      continue;
    }
    CHECK(text.written(quads) == text.written(triangles));
    CHECK(what_is_lost(quads, format).front() ==
          std::string(title_of(format)) +
              " holds no quadrilaterals that repeat a corner: 3 are written as the triangles that they are");
  }
}

TEST_CASE(
    "where a format holds triangles only, a quadrilateral is written as the two of its shorter diagonal that is "
    "inside") {
  MeshDocument document;
  // A square that leans, one that leans the other way, and an arrow head whose shorter diagonal is outside.
  document.points = {0, 0, 0, 2, 0, 0, 3, 2, 0, 1, 2, 0, 5, 0, 0, 3.5, 2, 0, 2, 3, 0, 2, 9, 0};
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 2, 3});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{1, 4, 2});
  document.cells.append(cell_type::polygon, std::vector<std::int32_t>{3, 6, 2, 7});
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{4, 5, 2, 1});
  document.cell_arrays = {make_data_array("freefem:label", 1, std::vector<std::int32_t>{7, 8, 9, 6})};
  document.format = FileFormat::freefem;
  const TextFormat freefem{std::string(extensions_of(FileFormat::freefem).front())};
  const MeshDocument read = freefem.read(freefem.written(document));
  CHECK(read.cells.types == std::vector<std::uint8_t>(7, cell_type::triangle));
  CHECK(read.cells.connectivity ==
        std::vector<std::int32_t>{1, 2, 3, 1, 3, 0, 1, 4, 2, 6, 2, 7, 6, 7, 3, 5, 2, 1, 5, 1, 4});
  CHECK(what_is_lost(document, FileFormat::freefem).front() ==
        "FreeFem holds triangles only: 3 quadrilaterals are written as the two each into which their shorter diagonals "
        "cut them");
}

TEST_CASE("where a format holds triangles only, halves of quadrilaterals are in their sets") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{1, 4, 2});
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 2, 3});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cell_sets = {{"all", {2, 1, 0}}, {"rest", {0}}};
  const MeshDocument halved = trismooth::with_halved_quads(document);
  CHECK(halved.cells.offsets == std::vector<std::int64_t>{0, 3, 6, 9, 11});
  CHECK(halved.cell_sets == std::vector<NamedSet>{{"all", {3, 1, 2, 0}}, {"rest", {0}}});
}

TEST_CASE(
    "a quadrilateral of eight nodes that repeats a corner is a triangle of six where these are all that is held") {
  MeshDocument document;
  document.points = {0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::quadratic_quad, std::vector<std::int32_t>{0, 1, 2, 2, 3, 4, 2, 5});
  const trismooth::CellList cells = with_collapsed_quads_as_triangles(document).cells;
  CHECK(cells.types == std::vector<std::uint8_t>{cell_type::quadratic_triangle});
  CHECK(cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5});
  const TextFormat stl{".stl"};
  CHECK(stl.read(stl.written(document)).cells.types == std::vector<std::uint8_t>{cell_type::triangle});
}

TEST_CASE("Lagrange cells of higher order are no others") {
  MeshDocument document;
  document.points.resize(48);
  document.cells.append(cell_type::lagrange_triangle, std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  document.cells.append(cell_type::lagrange_curve, std::vector<std::int32_t>{0, 1, 3, 4});
  CHECK_FALSE(has_cells_of_any_order(document));
  CHECK(with_fixed_orders(document).cells.types == document.cells.types);
}

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::mfem_test {

namespace type = cell_type;

const std::string disc =
    "MFEM mesh v1.3\n\ndimension\n2\n\nelements\n3\n7 2 0 1 2\n7 2 0 2 3\n9 3 1 4 5 2\n\n"
    "attribute_sets\n3\n\"air\" 1 7\n\"steel core\" 1 9\n\"everything\" 2 7 9\n\n"
    "boundary\n2\n3 1 0 1\n4 1 3 0\n\nbdr_attribute_sets\n1\n\"inlet\" 1 4\n\n"
    "vertices\n6\n2\n0 0\n1.50 0\n1 1\n0 1\n2 0\n2 1\n\nmfem_mesh_end\n";

std::string refusal_of(const std::string& bytes) {
  const ScratchFolder folder;
  return message_of<trismooth::ReadError>([path = folder.write("a.mesh", bytes)] { read_mesh(path); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Four triangles around a point, up to the 20 lines before its nodes.
const std::string fan =
    "MFEM mesh v1.0\n\ndimension\n2\n\nelements\n4\n1 2 0 1 4\n1 2 1 2 4\n1 2 2 3 4\n1 2 3 0 4\n\n"
    "boundary\n2\n1 1 0 1\n1 1 2 1\n\nvertices\n5\n\n";

using Place = std::array<std::string, 2>;
using Places = std::vector<Place>;

/// A grid function: all x and then all y, or x and y of each place.
std::string nodes_of(const std::string& collection, bool by_axis, const Places& places) {
  std::string text = "nodes\nFiniteElementSpace\nFiniteElementCollection: " + collection +
                     "\nVDim: 2\nOrdering: " + (by_axis ? "0" : "1") + "\n\n";
  for (std::size_t axis = 0; axis < 2 && by_axis; ++axis) {
    for (const Place& place : places) {
      text += place[axis] + "\n";
    }
  }
  for (std::size_t i = 0; i < places.size() && !by_axis; ++i) {
    text += places[i][0] + " " + places[i][1] + "\n";
  }
  return text;
}

/// Place i at (i, 0, i + 1/2).
std::string numbered_places(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += std::to_string(i) + " 0 " + std::to_string(i) + ".5\n";
  }
  return text;
}

std::vector<std::int32_t> attributes_of(const MeshDocument& document) {
  const auto values = document.cell_arrays.at(0).as<std::int32_t>();
  return {values.begin(), values.end()};
}

TEST_CASE("an MFEM mesh is elements and then its boundary, with attributes and their names") {
  const ScratchFolder folder;
  const MeshDocument document = read_mesh(folder.write("disc.mesh", disc));
  CHECK(document.format == FileFormat::mfem);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1.5, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0});
  CHECK(document.cells.types ==
        std::vector<std::uint8_t>{type::triangle, type::triangle, type::quad, type::line, type::line});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 1, 4, 5, 2, 0, 1, 3, 0});
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].name == "mfem:attribute");
  CHECK(attributes_of(document) == std::vector<std::int32_t>{7, 7, 9, 3, 4});
  const auto& names = document.cell_arrays[0].description->value_names;
  CHECK(names == std::vector<trismooth::ValueName>{{7, 2, "air"}, {9, 2, "steel core"}, {4, 1, "inlet"}});
  CHECK(document.cell_sets == std::vector<trismooth::NamedSet>{{"everything", {0, 1, 2}}});
}

TEST_CASE("a document of another format becomes an MFEM mesh with its groups") {
  const ScratchFolder folder;
  MeshDocument document = read_mesh(folder.write("disc.mesh", disc));
  document.original = nullptr;
  CHECK(what_is_lost(document, FileFormat::mfem) ==
        std::vector<std::string>{"MFEM holds no sets of cells: everything is not written"});
  write_mesh(folder / "again.mesh", document);
  const MeshDocument again = read_mesh(folder / "again.mesh");
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(attributes_of(again) == attributes_of(document));
  CHECK(again.cell_arrays[0].description->value_names == document.cell_arrays[0].description->value_names);
}

TEST_CASE("attributes of MFEM are positive; points in space keep their z; lines are the boundary") {
  const ScratchFolder folder;
  MeshDocument document;
  document.format = FileFormat::mfem;  // of the formats that the extension names
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0.5};
  document.cells.append(type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(type::vertex, std::vector<std::int32_t>{2});
  document.cell_arrays.push_back(trismooth::make_data_array("region", 1, std::vector<std::int32_t>{-5, 12, 0}));
  const auto lost = what_is_lost(document, FileFormat::mfem);
  CHECK(lost == std::vector<std::string>{
                    "MFEM holds lines, triangles and quadrilaterals only: 1 cell of type vertex is not written",
                    "MFEM lists lines apart from faces: the cells are written in another order"});
  write_mesh(folder / "a.mesh", document);
  CHECK(bytes_of(folder / "a.mesh") ==
        "MFEM mesh v1.0\n\ndimension\n2\n\nelements\n1\n12 2 0 1 2\n\nboundary\n1\n1 1 0 1\n\nvertices\n3\n3\n0 0 0\n"
        "1 0 0\n1 1 0.5\n");
}

TEST_CASE(
    "vertices have the places that nodes of degree 1 give them, which are written back in the form that they have") {
  const Places shared{{"0", "0"}, {"2", "0"}, {"2", "2"}, {"0", "2"}, {".750", "1.25"}};
  const Places of_elements{shared[0], shared[1], shared[4], shared[1], shared[2], shared[4],
                           shared[2], shared[3], shared[4], shared[3], shared[0], shared[4]};
  for (const auto& [collection, places] : std::vector<std::pair<std::string, Places>>{
           {"H1_2D_P1", shared}, {"Linear", shared}, {"L2_T1_2D_P1", of_elements}}) {
    for (const bool by_axis : {true, false}) {
      CAPTURE(collection, by_axis);
      const ScratchFolder folder;
      const std::string bytes = fan + nodes_of(collection, by_axis, places);
      MeshDocument document = read_mesh(folder.write("a.mesh", bytes));
      CHECK(document.points == std::vector<double>{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0});
      CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 1, 2, 1});
      document.points[12] = 1;
      document.points[13] = 1.5;
      write_mesh(folder / "moved.mesh", document);
      Places moved = places;
      std::ranges::replace(moved, shared[4], Place{"1", "1.5"});
      CHECK(bytes_of(folder / "moved.mesh") == fan + nodes_of(collection, by_axis, moved));
    }
  }
}

TEST_CASE("nodes of degree 2 have the middles of edges behind the vertices, in the order in which elements have them") {
  // Edges 01, 14, 40, then 12 and 24, then 23 and 34, then 30: 14 is the same as 41.
  const Places places{{"0", "0"},      {"2", "0"},     {"2", "2"}, {"0", "2"}, {".75", "1.25"},
                      {"1", "-0.125"}, {"1.375", "5"}, {"8", "4"}, {"2", "1"}, {"1.375", "1.625"},
                      {"1", "2"},      {"7", "1.625"}, {"0", "1"}};
  Places of_elements;
  for (const auto& row : std::vector<std::vector<std::size_t>>{
           {0, 5, 1, 7, 6, 4}, {1, 8, 2, 6, 9, 4}, {2, 10, 3, 9, 11, 4}, {3, 12, 0, 11, 7, 4}}) {
    for (const std::size_t place : row) {
      of_elements.push_back(places[place]);
    }
  }
  for (const auto& [collection, of_file] : std::vector<std::pair<std::string, Places>>{
           {"H1_2D_P2", places}, {"Quadratic", places}, {"L2_T1_2D_P2", of_elements}}) {
    for (const bool by_axis : {true, false}) {
      CAPTURE(collection, by_axis);
      const ScratchFolder folder;
      const std::string bytes = fan + nodes_of(collection, by_axis, of_file);
      MeshDocument document = read_mesh(folder.write("a.mesh", bytes));
      CHECK(document.cells.types == std::vector<std::uint8_t>{type::quadratic_triangle, type::quadratic_triangle,
                                                              type::quadratic_triangle, type::quadratic_triangle,
                                                              type::quadratic_edge, type::quadratic_edge});
      CHECK(document.cells.connectivity == std::vector<std::int32_t>{0,  1,  4, 5, 6, 7, 1,  2, 4,  8, 9, 6, 2, 3, 4,
                                                                     10, 11, 9, 3, 0, 4, 12, 7, 11, 0, 1, 5, 2, 1, 8});
      REQUIRE(document.point_count() == places.size());
      for (std::size_t point = 0; point < places.size(); ++point) {
        CHECK(document.points[3 * point] == std::stod(places[point][0]));
        CHECK(document.points[3 * point + 1] == std::stod(places[point][1]));
      }
      document.points[3 * 6] = 1.5;
      write_mesh(folder / "moved.mesh", document);
      Places moved = of_file;
      std::ranges::replace(moved, places[6], Place{"1.5", "5"});
      CHECK(bytes_of(folder / "moved.mesh") == fan + nodes_of(collection, by_axis, moved));
    }
  }
}

TEST_CASE("quadrilaterals of degree 2 have their middles behind all edges; nodes in space have a z") {
  const ScratchFolder folder;
  const MeshDocument document = read_mesh(
      folder.write("a.mesh",
                   "MFEM mesh v1.0\ndimension\n2\nelements\n3\n1 3 0 1 2 3\n1 2 1 4 2\n1 3 4 5 6 2\nboundary\n0\n"
                   "vertices\n7\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_2D_P2\nVDim: 3\nOrdering: 1\n" +
                       numbered_places(18)));
  CHECK(document.cells.types ==
        std::vector<std::uint8_t>{type::biquadratic_quad, type::quadratic_triangle, type::biquadratic_quad});
  CHECK(document.cells.connectivity ==
        std::vector<std::int32_t>{0, 1, 2, 3, 7, 8, 9, 10, 16, 1, 4, 2, 11, 12, 8, 4, 5, 6, 2, 13, 14, 15, 12, 17});
  CHECK(document.points[3 * 17] == 17);
  CHECK(document.points[3 * 17 + 2] == 17.5);
}

TEST_CASE("nodes that are not the places of vertices and middles, or not one place each, are named") {
  const Places places{{"0", "0"}, {"2", "0"}, {"2", "2"}, {"0", "2"}, {".75", "1.25"}};
  const auto refusal = [&](const std::string& collection) {
    return refusal_of(fan + nodes_of(collection, true, places));
  };
  CHECK(refusal("H1_2D_P3").find(":23: is a curved mesh of MFEM of degree 3 ('H1_2D_P3')") != std::string::npos);
  CHECK(refusal("Cubic").find("of degree 3 ('Cubic')") != std::string::npos);
  CHECK(refusal("L2_T1_2D_P5").find("of degree 5") != std::string::npos);
  // Places inside of elements, Bernstein's coefficients.
  for (const char* const collection : {"L2_2D_P1", "H1Pos_2D_P2", "NURBS2", "RT_2D_P1"}) {
    CHECK(refusal(collection).find("whose numbers are not the places of vertices and middles of edges") !=
          std::string::npos);
  }
  Places periodic{places[0], places[1], places[4], places[1], places[2], places[4],
                  places[2], places[3], places[4], places[3], places[0], places[4]};
  periodic[10] = {"0", "4"};
  const std::string torn = refusal_of(fan + nodes_of("L2_T1_2D_P1", false, periodic));
  CHECK(torn.find(":37: vertex 0 is elsewhere here than in an element before: the mesh is periodic") !=
        std::string::npos);
  const std::string h1 = fan + nodes_of("H1_2D_P1", false, places);
  CHECK(refusal_of(replaced(h1, "vertices\n5", "vertices\n6")).find("vertex 5 is in no element") != std::string::npos);
  CHECK(refusal_of(replaced(h1, "1 2 3 0 4", "1 2 3 0 7")).find(":11: vertex 7 is out of range: the file has 5") !=
        std::string::npos);
  CHECK(refusal_of(replaced(h1, "vertices\n5", "vertices\n5\n2\n0 0\n1 0\n0 1\n0 0\n0 0")).find("has places twice") !=
        std::string::npos);
  CHECK(refusal_of(replaced(fan + nodes_of("H1_2D_P2", true, places), "1 1 0 1", "1 1 0 2"))
            .find("no element has the edge of vertices 0 and 2") != std::string::npos);
  CHECK(refusal_of(replaced(h1, "FiniteElementSpace", "MFEM FiniteElementSpace v1.0"))
            .find("expected 'FiniteElementSpace', got 'MFEM'") != std::string::npos);
  CHECK(refusal_of(replaced(h1, "vertices\n5", "vertices\n4")).find("vertex 4 is out of range") != std::string::npos);
  CHECK(refusal_of(h1.substr(0, h1.rfind(".75"))).find("declares 5 vertices, but the file has room for 4") !=
        std::string::npos);
}

TEST_CASE("what MFEM meshes are not read is said with its reason") {
  for (const auto& [version, reason] : std::vector<std::pair<std::string, std::string>>{
           {"MFEM NURBS mesh v1.0", "is a NURBS mesh"},
           {"MFEM NC mesh v1.0", "is a non-conforming mesh"},
           {"MFEM INLINE mesh v1.0", "is an INLINE mesh"},
           {"MFEM mesh v1.4", "expected 'MFEM mesh v1.0' to 'v1.3' in the first line, got 'MFEM mesh v1.4'"}}) {
    CHECK(refusal_of(replaced(disc, "MFEM mesh v1.3", version)).find(reason) != std::string::npos);
  }
  CHECK(refusal_of(replaced(disc, "\"inlet\" 1", "\"inlet 1")).find("expected the end of the name of a set") !=
        std::string::npos);
  CHECK(refusal_of(replaced(disc, "mfem_mesh_end", "vertex_parents")).find("is a non-conforming mesh") !=
        std::string::npos);
}

TEST_CASE("what is wrong in an MFEM mesh is named with its line") {
  CHECK(refusal_of(replaced(disc, "7 2 0 2 3", "7 2 0 2 6")).find(":9: vertex 6 is out of range: the file has 6") !=
        std::string::npos);
  CHECK(refusal_of(replaced(disc, "9 3 1", "9 8 1")).find(":10: expected a geometry from 0 to 7") != std::string::npos);
  CHECK(refusal_of(replaced(disc, "7 2 0 1 2\n7 2 0 2 3\n9 3", "7 2 0 1 2\n7 2 0 2 3\n9 2 1 2 9\n9 3"))
            .find(":11: expected a section of MFEM, got '9'") != std::string::npos);
  CHECK(refusal_of(replaced(disc, "vertices\n6", "vertices\n2000000000")).find("declares 2000000000 vertices") !=
        std::string::npos);
  CHECK(refusal_of(replaced(disc, "1.50 0", "nan 0")).find("expected a coordinate (a finite number), got 'nan'") !=
        std::string::npos);
  CHECK(refusal_of(replaced(disc, "\nmfem_mesh_end\n", "")).find("expected the end of the mesh, 'mfem_mesh_end'") !=
        std::string::npos);
  CHECK(refusal_of("MFEM mesh v1.0\n").find("expected the section 'vertices'") != std::string::npos);
}

}  // namespace trismooth::mfem_test

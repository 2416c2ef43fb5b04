// SPDX-License-Identifier: BSD-3-Clause
// Medit as text: what is read, written back, refused, and written from other formats.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/scratch_folder.h"

namespace trismooth::medit_test {

using byte_files::contains;
using byte_files::values;

/// Two triangles and a quadrilateral, with all that Medit says of them.
constexpr std::string_view medit_plate =
    "MeshVersionFormatted 2\n\n# made by hand\nDimension 2\n\nVertices\n6\n0 0 1\n1 0 1\n1 1 2\n0 1 0\n2 0 0\n2 1 "
    "-4\n\n"
    "Edges\n3\n1 2 10\n2 3 11\n5 6 10\n\nTriangles\n2\n1 2 3 7\n1 3 4 8\n\nQuadrilaterals\n1\n2 5 6 3 0\n\n"
    "Corners\n2\n1\n6\n\nRequiredVertices\n1\n4\n\nRidges\n1\n2\n\nRequiredEdges\n2\n1\n2\n\n"
    "RequiredTriangles\n1\n2\n\nNormals\n1\n0 1\n\nNormalAtVertices\n1\n1 1\n\nEnd\n";

MeshDocument as_medit(std::string_view text) {
  MeshDocument document = medit_codec.read("plate.mesh", text);
  document.format = FileFormat::medit;
  return document;
}

std::string medit_refusal(const std::string& text) {
  return byte_files::refusal(medit_codec, text);
}

std::string bytes_written_to(const MeshDocument& document, const std::string& name) {
  const ScratchFolder folder;
  write_mesh(folder / name, document);
  return bytes_of(folder / name);
}

MeshDocument two_triangles_and_a_line() {
  MeshDocument document;
  document.format = FileFormat::off;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 2, 3});
  return document;
}

TEST_CASE("Medit: vertices, cells, references and sets are read") {
  const MeshDocument document = as_medit(medit_plate);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0});
  CHECK(document.point_type == trismooth::ScalarType::float64);
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::line, cell_type::line, cell_type::line,
                                                          cell_type::triangle, cell_type::triangle, cell_type::quad});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 1, 2, 4, 5, 0, 1, 2, 0, 2, 3, 1, 4, 5, 2});
  CHECK(values<std::int32_t>(find_array(document.point_arrays, "medit:ref")) ==
        std::vector<std::int32_t>{1, 1, 2, 0, 0, -4});
  CHECK(values<std::int32_t>(find_array(document.cell_arrays, "medit:ref")) ==
        std::vector<std::int32_t>{10, 11, 10, 7, 8, 0});
  CHECK(document.point_sets == std::vector<NamedSet>{{"Corners", {0, 5}},
                                                     {"RequiredVertices", {3}},
                                                     {"Ridges", {1, 2}},
                                                     {"RequiredEdges", {0, 1, 2}},
                                                     {"RequiredTriangles", {0, 2, 3}}});
  REQUIRE(document.notes.size() == 1);
  CHECK(contains(document.notes[0], "Normals, NormalAtVertices"));
  CHECK(byte_files::is_valid(document));
}

TEST_CASE("Medit: the mesh is the same however the file is laid out") {
  const std::string text(medit_plate);
  const std::string laid_out = GENERATE_COPY(
      as<std::string>{}, text, replace_all(text, "Dimension 2", "Dimension\n2"), replace_all(text, "\n", "\r\n"),
      replace_all(text, "\n", "\r"), replace_all(text, " ", "\t"), replace_all(text, "\n", " # remark 1 2\n\n"),
      replace_all(text, "Triangles", "TRIANGLES"), "\xEF\xBB\xBF" + text, replace_all(text, "\nEnd\n", "\nEnd"),
      replace_all(text, "MeshVersionFormatted 2", "meshversionformatted 4"),
      // As FreeFem and BAMG write it, and others.
      replace_all(text, "\nEdges", "\nIdentifier\n\"Triangles 3 of a mesh\"\nGeometry \"a.gref\"\n\nEdges"),
      replace_all(text, "\nVertices", "\nAngleOfCornerBound 46\nVertices"),
      // As meshio writes it.
      replace_all(replace_all(text, "Edges\n3\n1 2 10\n", "Edges\n1\n1 2 10\nEdges\n2\n"), "Triangles\n2\n1 2 3 7\n",
                  "Triangles\n1\n1 2 3 7\nTriangles\n1\n"));
  CAPTURE(laid_out);
  const MeshDocument document = as_medit(laid_out);
  const MeshDocument expected = as_medit(medit_plate);
  CHECK(document.points == expected.points);
  CHECK(document.cells.connectivity == expected.cells.connectivity);
  CHECK(document.cells.types == expected.cells.types);
  CHECK(document.point_sets == expected.point_sets);
  CHECK(byte_files::written_back(document) == laid_out);
}

TEST_CASE("Medit: sections may stand in any order") {
  const MeshDocument document = as_medit(
      "MeshVersionFormatted 2\nRequiredEdges 1 1\nTriangles\n1\n1 2 3 5\nDimension 3\nEdges 1 3 1 6\nVertices\n3\n"
      "0 0 1 0\n1 0 1 0\n0 1 1 0\nEnd");
  CHECK(document.points == std::vector<double>{0, 0, 1, 1, 0, 1, 0, 1, 1});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 2, 0});
  CHECK(values<std::int32_t>(find_array(document.cell_arrays, "medit:ref")) == std::vector<std::int32_t>{5, 6});
  CHECK(find_array(document.point_arrays, "medit:ref") == nullptr);
  CHECK(document.point_sets == std::vector<NamedSet>{{"RequiredEdges", {0, 2}}});
  CHECK(document.notes.empty());
}

TEST_CASE("Medit: curved and solid cells are read in VTK's order") {
  const MeshDocument document = as_medit(
      "MeshVersionFormatted 2\nDimension 3\nVertices\n10\n0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0\n.5 0 0 0 .5 .5 0 0\n"
      "0 .5 0 0 0 0 .5 0 .5 0 .5 0 0 .5 .5 0\nEdgesP2\n1\n1 2 5 3\nTrianglesP2\n1\n1 2 3 5 6 7 4\nTetrahedra\n1\n"
      "1 2 3 4 5\nTetrahedraP2\n1\n1 2 3 4 5 6 7 8 9 10 6\nRequiredTriangles 1 1\nEnd\n");
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::quadratic_edge, cell_type::quadratic_triangle,
                                                          cell_type::tetrahedron, 24});
  CHECK(document.cells.offsets == std::vector<std::int64_t>{0, 3, 9, 13, 23});
  CHECK(document.point_sets == std::vector<NamedSet>{{"RequiredTriangles", {0, 1, 2, 4, 5, 6}}});
}

TEST_CASE("Medit: references of 64 bits are kept") {
  const MeshDocument document = as_medit(replace_all(std::string(medit_plate), "1 3 4 8", "1 3 4 -9000000000"));
  CHECK(values<std::int64_t>(find_array(document.cell_arrays, "medit:ref")) ==
        std::vector<std::int64_t>{10, 11, 10, 7, -9000000000, 0});
}

TEST_CASE("Medit: what breaks the rules is refused with the line and the reason") {
  const std::string text(medit_plate);
  struct Fault {
    std::string from, to, message;
  };
  for (const Fault& fault : {
           Fault{"MeshVersionFormatted 2", "Mesh 2", "mesh:1: is no Medit file"},
           {"MeshVersionFormatted 2", "MeshVersionFormatted 5", "mesh:1: expected a version of the format from 0 to 4"},
           {"Dimension 2", "Dimension 4", "mesh:4: expected the dimension from 2 to 3, got '4'"},
           {"Dimension 2\n", "", "mesh:5: Vertices stand before the keyword Dimension"},
           {"0 0 1\n", "0 x 1\n", "mesh:8: expected a coordinate (a finite number), got 'x'"},
           {"0 0 1\n", "0 nan 1\n", "mesh:8: expected a coordinate (a finite number), got 'nan'"},
           {"0 0 1\n", "0 0 1.5\n", "mesh:8: expected a reference (a whole number), got '1.5'"},
           {"Vertices\n6", "Vertices\n7", "expected a coordinate (a finite number), got 'Edges'"},
           {"Vertices\n6", "Vertices\n5", "mesh:13: expected a keyword after the declared 5 of Vertices, got '2'"},
           {"Vertices\n6", "Vertices\n2000000000", "declares 2000000000 Vertices, but the file has room for"},
           {"Vertices\n6", "Vertices\n-6", "mesh:7: expected the number of Vertices from 0 to"},
           {"1 3 4 8", "1 3 7 8",
            "mesh:24: expected a vertex number, got '7'; the file has 6 vertices, counted from 1"},
           {"1 3 4 8", "0 3 4 8", "mesh:24: expected a vertex number, got '0'"},
           {"Triangles\n2", "Triangles\n1", "mesh:24: expected a keyword after the declared 1 of Triangles, got '1'"},
           {"Quadrilaterals\n1\n2 5 6 3 0", "Corners\n1\n2", "mesh:30: a second Corners"},
           {"Quadrilaterals", "Polygons", "mesh:26: Polygons are not read"},
           {"Corners\n2\n1\n6", "Corners\n2\n1\n7",
            "mesh:33: Corners: expected a number from 1 to that of the vertices, 6, got '7'"},
           {"Ridges\n1\n2", "Ridges\n1\n4", "Ridges: expected a number from 1 to that of the edges, 3, got '4'"},
           {"RequiredTriangles\n1\n2", "RequiredTriangles\n1\n0", "expected a number from 1 to 2147483647, got '0'"},
           {"Vertices\n6\n", "Something\n6\n", "expected the keyword Vertices, got the end of the file"},
       }) {
    const std::string message = medit_refusal(replace_all(text, fault.from, fault.to));
    INFO(message << "\nexpected: " << fault.message);
    CHECK(contains(message, fault.message));
  }
}

TEST_CASE("Medit: a file without End is read, and a note says that something may be missing") {
  const MeshDocument document = as_medit(replace_all(std::string(medit_plate), "\nEnd\n", ""));
  REQUIRE_FALSE(document.notes.empty());
  CHECK(contains(document.notes[0], "no End"));
}

TEST_CASE("Medit: a mesh from elsewhere is written with its groups as references") {
  MeshDocument document = two_triangles_and_a_line();
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<std::int32_t>{3, 8, 4}));
  document.cell_arrays.push_back(make_data_array("temperature", 1, std::vector<double>{1, 2, 3}));
  document.point_arrays.push_back(make_data_array("label", 1, std::vector<std::uint8_t>{1, 0, 0, 2}));
  document.point_sets = {{"Corners", {3, 0}}, {"RequiredEdges", {1, 0}}, {"inlet", {2}}};
  CHECK(bytes_written_to(document, "out.mesh") ==
        "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 1\n1 0 0\n1 1 0\n0 1 2\nEdges\n1\n1 2 8\n"
        "Triangles\n2\n1 2 3 3\n1 3 4 4\nCorners\n2\n1\n4\nRequiredVertices\n2\n1\n2\nEnd\n");
  CHECK(what_is_lost(document, FileFormat::medit) ==
        std::vector<std::string>{"Medit holds no cell arrays: temperature is not written",
                                 "Medit gets the vertices of RequiredEdges as RequiredVertices",
                                 "Medit holds no sets of points: inlet is not written",
                                 "Medit lists cells by their type: they are written in another order"});
  // Where the document has the edges, too, they are required themselves.
  document.cell_sets = {{"RequiredEdges", {1}}, {"Ridges", {0}}, {"hot", {2}}};
  document.point_sets = {{"RequiredEdges", {1, 0}}};
  CHECK(contains(bytes_written_to(document, "out.mesh"), "1 3 4 4\nRequiredEdges\n1\n1\nEnd\n"));
  CHECK(what_is_lost(document, FileFormat::medit) ==
        std::vector<std::string>{"Medit holds no cell arrays: temperature is not written",
                                 "Medit holds no sets of cells: Ridges, hot are not written",
                                 "Medit lists cells by their type: they are written in another order"});
}

TEST_CASE("Medit: z is written where it is not 0, and cells that Medit has not are named") {
  MeshDocument document = two_triangles_and_a_line();
  document.points[2] = 0.5;
  document.cells.append(cell_type::polygon, std::vector<std::int32_t>{0, 1, 2, 3, 1});
  CHECK(bytes_written_to(document, "out.mesh") ==
        "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0.5 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\nEdges\n1\n1 2 0\n"
        "Triangles\n2\n1 2 3 0\n1 3 4 0\nEnd\n");
  REQUIRE(what_is_lost(document, FileFormat::medit).size() == 2);
  CHECK(contains(what_is_lost(document, FileFormat::medit)[0], "1 cell of type polygon is not written"));
}

TEST_CASE("Medit: a compressed .meshb is binary, whatever it is made of") {
  const ScratchFolder folder;
  MeshDocument document = two_triangles_and_a_line();
  for (const FileFormat format : {FileFormat::off, FileFormat::medit}) {
    if (format == FileFormat::medit) {
      document = trismooth::read_mesh(folder.write("in.mesh", medit_plate));
    }
    write_mesh(folder / "out.meshb", document);
    write_mesh(folder / "out.meshb.gz", document);
    const auto plain = trismooth::read_mesh(folder / "out.meshb");
    const auto compressed = trismooth::read_mesh(folder / "out.meshb.gz");
    CHECK(bytes_of(folder / "out.meshb").substr(0, 4) == std::string("\1\0\0\0", 4));
    CHECK(compressed.points == plain.points);
    CHECK(compressed.cells.connectivity == plain.cells.connectivity);
    // As the same encoding it is written back byte by byte.
    write_mesh(folder / "again.meshb", compressed);
    CHECK(bytes_of(folder / "again.meshb") == bytes_of(folder / "out.meshb"));
  }
}

TEST_CASE("Medit: cells of any type go from one encoding to the other") {
  const ScratchFolder folder;
  const std::string text =
      "MeshVersionFormatted 2\nDimension 2\nVertices\n10\n0 0 0\n3 0 0\n0 3 0\n1 0 0\n2 0 0\n2 1 0\n1 2 0\n0 2 0\n"
      "0 1 0\n1 1 0\nEdgesP3\n1\n1 2 4 5 1\nTrianglesP3\n1\n1 2 3 4 5 6 7 8 9 10 2\nTriangles\n2\n1 2 3 7\n1 4 9 8\n"
      "RequiredTriangles\n1\n2\nEnd\n";
  const MeshDocument document = trismooth::read_mesh(folder.write("in.mesh", text));
  write_mesh(folder / "out.meshb", document);
  write_mesh(folder / "back.mesh", trismooth::read_mesh(folder / "out.meshb"));
  const MeshDocument again = trismooth::read_mesh(folder / "back.mesh");
  CHECK(again.cells.types == document.cells.types);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(again.point_sets == document.point_sets);
}

TEST_CASE("Medit: what is written from its own document as the other encoding is the same mesh") {
  const ScratchFolder folder;
  const MeshDocument document = trismooth::read_mesh(folder.write("in.mesh", medit_plate));
  write_mesh(folder / "out.meshb", document);
  CHECK(bytes_of(folder / "out.meshb").substr(0, 4) == std::string("\1\0\0\0", 4));
  CHECK(document.cell_sets ==
        std::vector<NamedSet>{{"Ridges", {1}}, {"RequiredEdges", {0, 1}}, {"RequiredTriangles", {4}}});
  CHECK(trismooth::read_mesh(folder / "out.meshb").cell_sets == document.cell_sets);
  CHECK(trismooth::read_mesh(folder / "out.meshb").point_sets == document.point_sets);
  const MeshDocument again = trismooth::read_mesh(folder / "out.meshb");
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(again.cells.types == document.cells.types);
  CHECK(values<std::int32_t>(find_array(again.cell_arrays, "medit:ref")) ==
        values<std::int32_t>(find_array(document.cell_arrays, "medit:ref")));
  CHECK(values<std::int32_t>(find_array(again.point_arrays, "medit:ref")) ==
        values<std::int32_t>(find_array(document.point_arrays, "medit:ref")));
}

}  // namespace trismooth::medit_test

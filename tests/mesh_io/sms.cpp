// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/says.h"
#include "support/text_format.h"

using trismooth::FileFormat;
using trismooth::find_array;
using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::NamedSet;
using trismooth::ValueName;
using trismooth::what_is_lost;

namespace cell_type = trismooth::cell_type;

namespace {

const TextFormat sms(".2dm");

const std::string river =
    "MESH2D\nMESHNAME \"a river\"\nNUM_MATERIALS_PER_ELEM 1\n"
    "E3T 1 1 2 3 7\nE4Q 2 1 3 4 5 8\nE2L 3 1 2 7\n"
    "ND 1 0 0 -1.50000000e+000\nND 2 1 0 2\nND 3 1 1 3\nND 4 0.5 2 4\nND 5 0 1 5\n"
    "NS 1 2\nNS -3 12\nNS 4 -5 \"the inlet\"\nNS 1 -2\n"
    "GM \"Mesh # one\"\nMAT 7 \"sand # 1\"\nMAT 9 \"none\"\n";

}  // namespace

TEST_CASE("2dm: nodes, elements, materials and nodestrings are read, other cards are named") {
  const MeshDocument document = sms.read(river);
  CHECK(document.format == FileFormat::sms);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0.5, 2, 0, 0, 1, 0});
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::quad, cell_type::line});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 4, 0, 1});
  CHECK(values_of<double>(document.point_arrays, "elevation") == std::vector<double>{-1.5, 2, 3, 4, 5});
  CHECK(document.arrays_of_places == std::vector<std::string>{"elevation"});
  CHECK(values_of<std::int64_t>(document.cell_arrays, "2dm:material") == std::vector<std::int64_t>{7, 8, 7});
  CHECK(find_array(document.cell_arrays, "2dm:material")->description->value_names ==
        std::vector<ValueName>{{7, 1, "sand # 1"}, {7, 2, "sand # 1"}});
  CHECK(document.point_sets ==
        std::vector<NamedSet>{{"nodestring 12", {0, 1, 2}}, {"the inlet", {3, 4}}, {"nodestring 3", {0, 1}}});
  CHECK(document.notes == std::vector<std::string>{"Cards that are kept in 2dm output only: 'GM'."});
  CHECK(sms.written(document) == river);
}

TEST_CASE("2dm: an elevation may be no number, which stays as it is written") {
  for (const std::string none : {"nan", "NaN", "NAN", "-nan"}) {
    CAPTURE(none);
    const std::string text = replace_all(river, "ND 2 1 0 2", "ND 2 1 0 " + none);
    MeshDocument document = sms.read(text);
    CHECK(std::isnan(values_of<double>(document.point_arrays, "elevation").at(1)));
    CHECK(sms.written(document) == text);
    document.points[3] = 1.75;
    CHECK(sms.written(document) == replace_all(text, "ND 2 1 0", "ND 2 1.75 0"));
  }
}

TEST_CASE("2dm: nodes along the sides of an element are corners first in a cell, and go back the same way") {
  std::string text = "MESH2D\nNUM_MATERIALS_PER_ELEM 1\n";
  text += "E6T 1 1 2 3 4 5 6 0\nE8Q 2 1 2 3 4 5 6 7 8 0\nE9Q 3 1 2 3 4 5 6 7 8 9 0\nE3L 4 1 2 3 0\n";
  for (int i = 1; i < 10; ++i) {
    text += "ND " + std::to_string(i) + " " + std::to_string(i) + " 0 0\n";
  }
  MeshDocument document = sms.read(text);
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::quadratic_triangle, cell_type::quadratic_quad,
                                                          cell_type::biquadratic_quad, cell_type::quadratic_edge});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 2, 4, 1, 3, 5,           //
                                                                 0, 2, 4, 6, 1, 3, 5, 7,     //
                                                                 0, 2, 4, 6, 1, 3, 5, 7, 8,  //
                                                                 0, 2, 1});
  document.original = nullptr;
  CHECK(sms.written(document) == text);
}

TEST_CASE("2dm: the mesh is the same in any order of cards, with any line ends and with comments") {
  const MeshDocument plain = sms.read(river);
  const std::size_t nodes = river.find("ND 1");
  const std::size_t strings = river.find("NS 1");
  const std::size_t elements = river.find("E3T");
  const std::string nodes_first = river.substr(0, elements) + river.substr(nodes, strings - nodes) +
                                  river.substr(elements, nodes - elements) + river.substr(strings);
  for (const std::string& text :
       {replace_all(river, "\n", "\r\n"), replace_all(river, "\n", "\r"), nodes_first, "# a mesh\n\n" + river,
        "\xEF\xBB\xBF" + river, replace_all(river, "E3T 1 1", " E3T\t1   1"), river.substr(0, river.size() - 1),
        replace_all(river, "ND 2 1 0 2", "# ND 9\nND 2 1 0 2 # the second"),
        replace_all(river, "ND 2 1 0", "ND 2 1.D0 +0")}) {
    CAPTURE(text);
    const MeshDocument document = sms.read(text);
    CHECK(document.points == plain.points);
    CHECK(document.cells.connectivity == plain.cells.connectivity);
    CHECK(document.point_sets == plain.point_sets);
    CHECK(values_of<double>(document.point_arrays, "elevation") == values_of<double>(plain.point_arrays, "elevation"));
    CHECK(sms.written(document) == text);
  }
}

TEST_CASE("2dm: tables behind cards that are kept, as of time curves, are kept with them") {
  const std::string curves =
      "BEGCURVE Version: 1\nXYS 1 3 \"inflow\"\n0.0 1.5\n1.0 2D0\n-2.0 1e3\nXYS 2 1 \"level\"\n0 0\nENDCURVE\n";
  const std::string text = river + curves + "NS 2 -3\n";
  const MeshDocument document = sms.read(text);
  CHECK(document.points == sms.read(river).points);
  CHECK(document.point_sets.back() == NamedSet{"nodestring 4", {1, 2}});
  CHECK(document.notes ==
        std::vector<std::string>{"Cards that are kept in 2dm output only: 'BEGCURVE', 'ENDCURVE', 'GM', 'XYS'."});
  CHECK(sms.written(document) == text);
  // A row behind a card of the mesh is one whose card is missing.
  CHECK(says(sms.failure_of(river + "ND 6 3 3 0\n7 4 4 0\n"), "expected a card, got '7'"));
}

TEST_CASE("2dm: what is wrong is said with its line") {
  struct Fault {
    std::string text;
    std::string message;
  };
  for (const Fault& fault :
       {Fault{"", "mesh.2dm:1: is not a 2dm mesh: expected MESH2D, got the end of the file"},
        {"OFF\n", "mesh.2dm:1: is not a 2dm mesh: expected MESH2D, got 'OFF'"},
        {replace_all(river, "ND 2 1 0 2", "ND 2 1 nan 2"), "mesh.2dm:8: expected y (a finite number), got 'nan'"},
        {replace_all(river, "ND 2 1 0 2", "ND 2 1 0"), "mesh.2dm:8: expected z, got the end of the line"},
        {replace_all(river, "ND 2 1 0 2", "ND 1 1 0 2"), "mesh.2dm:8: node 1 stands in the file twice"},
        {replace_all(river, "E3T 1 1 2 3 7", "E3T 1 1 2 6 7"),
         "mesh.2dm:4: the element names node 6, which is none of the file"},
        {replace_all(river, "E3T 1 1 2 3 7", "E3T 1 1 2"), "mesh.2dm:4: expected a node, got the end of the line"},
        {replace_all(river, "E3T 1 1 2 3 7", "E3T 1 1 2 3 sand"),
         "mesh.2dm:4: expected the number of a material, got 'sand'"},
        {replace_all(river, "E3T 1", "E4T 1"), "mesh.2dm:4: expected an element of two dimensions "},
        {replace_all(river, "E3T 1", "17 1"), "mesh.2dm:4: expected a card, got '17'"},
        {replace_all(river, "NS 4 -5", "NS 4 -6"),
         "mesh.2dm:14: the nodestring names node 6, which is none of the file"},
        {replace_all(river, "NS -3 12\n", ""), ""},
        {replace_all(river, "NS 1 -2\n", "NS 1 2\n"),
         "mesh.2dm:16: expected more of the nodestring, whose last node has a negative number, got 'GM'"},
        {"MESH2D\nND 1 0 0 0\nNS 1\n", "mesh.2dm:3: the nodestring has no last node"},
        {replace_all(river, "\"sand # 1\"", "\"sand"), "mesh.2dm:17: expected a quotation mark behind '\"sand'"},
        {replace_all(river, "MAT 9 \"none\"", "MAT 9"),
         "mesh.2dm:18: expected the name of a material, got the end of the line"}}) {
    CAPTURE(fault.text);
    CHECK_THAT(sms.failure_of(fault.text), Catch::Matchers::StartsWith(fault.message));
  }
}

TEST_CASE("2dm: a mesh of another format is written with its groups as materials, and sets as nodestrings") {
  MeshDocument document;
  document.points = {0, 0, 1, 1, 0, 1, 1, 1, 1};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::vertex, std::vector<std::int32_t>{0});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  auto materials = make_data_array("gmsh:physical", 1, std::vector<std::int32_t>{4, 1, 0});
  trismooth::ArrayDescription names;
  names.value_names = {{4, 2, "sand and clay"}};
  materials.description = std::make_shared<const trismooth::ArrayDescription>(names);
  document.cell_arrays = {materials, make_data_array("heat", 1, std::vector<double>{1, 2, 3})};
  document.point_sets = {{"inlet", {0, 1}}, {"nodestring 2", {2}}};
  CHECK(sms.written(document) ==
        "MESH2D\nNUM_MATERIALS_PER_ELEM 1\nE3T 1 1 2 3 4\nE2L 2 1 2 0\nND 1 0 0 1\nND 2 1 0 1\nND 3 1 1 1\n"
        "NS 1 -2 1\nNS -3 2\nMAT 4 \"sand and clay\"\n");
  CHECK(what_is_lost(document, FileFormat::sms) ==
        std::vector<std::string>{
            "2dm holds triangles, quadrilaterals and lines only: 1 cell of type vertex is not written",
            "2dm holds no cell arrays: heat is not written",
            "2dm numbers nodestrings, which have nodes: the names of sets of points, or empty sets, are not written: "
            "inlet"});
  document.point_arrays = {make_data_array("depth", 1, std::vector<double>{1.5, 0, -2})};
  const MeshDocument again = sms.read(sms.written(document));
  CHECK(values_of<double>(again.point_arrays, "elevation") == std::vector<double>{-1.5, 0, 2});
  CHECK(values_of<std::int64_t>(again.cell_arrays, "2dm:material") == std::vector<std::int64_t>{4, 0});
  CHECK(what_is_lost(document, FileFormat::sms).back() == "2dm holds x and y only: z, 1, is not written");
}

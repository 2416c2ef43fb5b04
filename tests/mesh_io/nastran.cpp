// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/scratch_folder.h"
#include "support/text_format.h"

namespace trismooth::nastran_test {

const TextFormat bdf(".bdf");

// Columns:     12345678        16              32              48
const std::string small_plate =
    "GRID    1               0.      0.      0.\n"
    "GRID    2               2.      0.      0.\n"
    "GRID    3               2.      2.      0.\n"
    "GRID    4               0.      2.      0.\n"
    "GRID    5               .75     1.25    0.\n";

const std::string large_plate =
    "GRID*   1                               0.              0.\n*       0.\n"
    "GRID*   2                               2.              0.\n*       0.\n"
    "GRID*   3                               2.              2.\n*       0.\n"
    "GRID*   4                               0.              2.\n*       0.\n"
    "GRID*   5                               .75             1.25\n*       0.\n";

const std::string free_plate =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nGRID,4,,0.,2.,0.\nGRID,5,,.75,1.25,0.\n";

const std::string small_triangles =
    "CTRIA3  1       7       1       2       5\n"
    "CTRIA3  2       7       2       3       5\n"
    "CTRIA3  3       9       3       4       5\n"
    "CTRIA3  4       9       4       1       5\n";

const std::vector<double> plate_points{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0};
const std::vector<std::int32_t> plate_triangles{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};

std::vector<std::int64_t> properties_of(const MeshDocument& document) {
  return values_of<std::int64_t>(document.cell_arrays, "nastran:pid");
}

/// The text with the last node of the plate at x and y.
std::string with_middle_at(const std::string& text, double x, double y) {
  MeshDocument document = bdf.read(text);
  document.points[12] = x;
  document.points[13] = y;
  const std::string written = bdf.written(document);
  // Whatever is written is read with the places that it was written with.
  const MeshDocument again = bdf.read(written);
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(again.point_sets == document.point_sets);
  return written;
}

TEST_CASE("Nastran: small, large and free field state the same mesh, and mixed ones too") {
  const std::string large_triangles =
      "CTRIA3* 1               7               1               2               *A1\n*A1     5\n"
      "CTRIA3* 2               7               2               3\n*       5\n"
      "CTRIA3* 3               9               3               4\n*       5\n"
      "CTRIA3* 4               9               4               1\n*       5\n";
  const std::string free_triangles =
      "CTRIA3,1,7,1,2,5\nctria3, 2 , 7,2,3,5\nCTRIAR,3,9,3,4,5\nCTRIA3*,4,9,4,1,*X\n*X,5\n";
  const std::vector<std::string> spellings{small_plate,
                                           large_plate,
                                           free_plate,
                                           small_plate.substr(0, 86) + free_plate.substr(34),
                                           replace_all(small_plate, ".75     1.25    ", "7.5-1   .125+1  "),
                                           replace_all(small_plate, ".75     1.25    ", "  +.75D0  125.-2"),
                                           replace_all(small_plate, ".75     1.25    ", "7.5e-01 1.25E0  "),
                                           replace_all(small_plate, "2.      0.      0.", "2.              "),
                                           replace_all(small_plate, "GRID    ", "grid\t"),
                                           replace_all(small_plate, "               ", "\t\t"),
                                           replace_all(free_plate, "0.,2.,0.", ",2."),
                                           replace_all(free_plate, "GRID,5,,.75,1.25,0.", "GRID*,5,,.75,1.25,+\n*,")};
  for (const std::string& nodes : spellings) {
    for (const std::string& triangles : {small_triangles, large_triangles, free_triangles}) {
      CAPTURE(nodes, triangles);
      for (const std::string& text : {nodes + triangles, triangles + "$ nodes\n" + nodes + "ENDDATA\nnot a card\n",
                                      "SOL 101\nCEND\nSPC = 1\n  begin bulk\n" + nodes + triangles + "ENDDATA"}) {
        const MeshDocument document = bdf.read(text);
        CHECK(document.format == FileFormat::nastran);
        CHECK(document.points == plate_points);
        CHECK(document.cells.types == std::vector<std::uint8_t>(4, cell_type::triangle));
        CHECK(document.cells.connectivity == plate_triangles);
        CHECK(properties_of(document) == std::vector<std::int64_t>{7, 7, 9, 9});
        CHECK(bdf.written(document) == text);
      }
    }
  }
}

TEST_CASE("Nastran: what does not move stays byte for byte, whatever it is") {
  const std::string text =
      "\xEF\xBB\xBF$ a deck\r\nID A,B\r\nSOL 101\r\nCEND\r\nTITLE = GRID\r\nBEGIN BULK\r\nPARAM,POST,-1\r\n"
      "$ between\r\n\r\n" +
      replace_all(small_plate, "\n", "   $ a node\r\n") + "MAT1\t1\t2.1+11\r\n" +
      replace_all(small_triangles, "\n", "\r\n") +
      "PSHELL  7       1       .1      1               1\r\n+       2.\r\n" + "ENDDATA\r\n$ behind\r\nGRID\r\n\x1A";
  const MeshDocument document = bdf.read(text);
  CHECK(document.points == plate_points);
  CHECK(bdf.written(document) == text);
  CHECK(document.notes ==
        std::vector<std::string>{"Cards that are kept in Nastran output only: 'MAT1', 'PARAM', 'PSHELL'."});
}

TEST_CASE("Nastran: a short number takes the place of the old one, with the blanks of its columns") {
  CHECK(with_middle_at(small_plate + small_triangles, 1, -0.125) ==
        replace_all(small_plate, ".75     1.25    ", "1.      -.125   ") + small_triangles);
  const std::string right = replace_all(small_plate, ".75     1.25    ", "     .75    1.25");
  CHECK(with_middle_at(right + small_triangles, 1, -0.125) ==
        replace_all(small_plate, ".75     1.25    ", "      1.   -.125") + small_triangles);
  const std::string within = replace_all(small_plate, ".75     1.25    ", "   .75    1.25  ");
  CHECK(with_middle_at(within + small_triangles, 1, 1234.625) ==
        replace_all(small_plate, ".75     1.25    ", "   1.   1234.625") + small_triangles);
  CHECK(with_middle_at(large_plate, 0.333333333333333, -1e-20) ==
        replace_all(large_plate, ".75             1.25\n", ".333333333333333-1.-20\n"));
}

TEST_CASE("Nastran: a number that needs more than a small field brings its node into large field") {
  const double third = 0.333333333333333;
  const std::string before = small_plate.substr(0, small_plate.rfind("GRID"));
  CHECK(with_middle_at(small_plate + small_triangles, third, 1.25) ==
        before +
            "GRID*   5                               .333333333333333"
            "1.25\n*       0.\n" +
            small_triangles);
  // All other fields stay, and so do comments and line ends.
  const std::string full =
      "grid    5       0       .75     1.25    0.      0       123     8       +G      $ a\r\n+G\r\n";
  CHECK(with_middle_at(before + full + small_triangles, 0.75, third) ==
        before +
            "grid*   5               0               .75             .333333333333333\r\n"
            "*       0.              0               123             8               +G      $ a\r\n+G\r\n" +
            small_triangles);
  const std::string commented = "GRID    5               .75     1.25    0. $ a\n";
  CHECK(with_middle_at(before + commented + small_triangles, 0.75, third) ==
        before + "GRID*   5                               .75             .333333333333333\n*       0. $ a\n" +
            small_triangles);
}

TEST_CASE("Nastran: free field stays free, and fields that were left out are added") {
  const double third = 0.333333333333333;
  const std::string before = free_plate.substr(0, free_plate.rfind("GRID"));
  CHECK(with_middle_at(free_plate, third, 1) == before + "GRID,5,,.333333333333333,1.,0.\n");
  CHECK(with_middle_at(before + "GRID, 5 ,, .75 , 1.25 ,0. $ a\n", third, 1) ==
        before + "GRID, 5 ,, .333333333333333 , 1. ,0. $ a\n");
  CHECK(with_middle_at(before + "GRID,5  $ a\n", third, 1) == before + "GRID,5,,.333333333333333,1.  $ a\n");
  CHECK(with_middle_at(before + "GRID,5,,,,\n", third, 1) == before + "GRID,5,,.333333333333333,1.,\n");
  MeshDocument document = bdf.read(before + "GRID*,5,,.75,1.25\r\nENDDATA");
  document.points[14] = 0.5;
  CHECK(bdf.written(document) == before + "GRID*,5,,.75,1.25\r\n*,.5\r\nENDDATA");
  document = bdf.read(before + "GRID*,5,,.75,1.25,*G\n*G,0.,1\n");
  document.points[14] = 0.5;
  CHECK(bdf.written(document) == before + "GRID*,5,,.75,1.25,*G\n*G,.5,1\n");
}

TEST_CASE("Nastran: coordinates that columns leave out are 0, and are written where they are not any more") {
  const std::string nodes = "GRID    1\nGRID    2               1.\nGRID*   3                               1.\n";
  MeshDocument document = bdf.read(nodes);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 0, 0});
  CHECK(bdf.written(document) == nodes);
  document.points = {0, 0, 3, 1, 2, 0, 1, 0, 4};
  const std::string written = bdf.written(document);
  CHECK(written ==
        "GRID*   1\n*       3.\nGRID*   2                               1.              2.\n*\n"
        "GRID*   3                               1.\n*       4.\n");
  CHECK(bdf.read(written).points == document.points);
}

TEST_CASE("Nastran: a coordinate gets the nearest number of 16 characters") {
  const MeshDocument document = bdf.read(small_plate);
  CHECK(document.most_coordinate_characters == 16);
  CHECK(document.coordinate_form == NumberForm::nastran);
  MeshDocument moved = document;
  moved.points[12] = -1.0 / 3e5;
  moved.points[13] = 1e100 / 3;
  const MeshDocument again = bdf.read(bdf.written(moved));
  CHECK(again.points[12] == -3.33333333333e-6);
  CHECK(again.points[13] == 3.33333333333e99);
}

TEST_CASE("Nastran: elements of all kinds are cells in the order of their cards, corners first") {
  std::string nodes;
  for (int i = 1; i <= 20; ++i) {
    nodes += "GRID," + std::to_string(i) + ",," + std::to_string(i) + ".\n";
  }
  const std::string cards =
      "CTRIA6  1       1       1       2       3       4       5       6\n"
      "CQUAD8  2       1       1       2       3       4       5       6       +Q      \n+Q      7       8\n"
      "CTRIAX6 3       1       1       2       3       4       5       6\n"
      "CTRIA6  4       1       1       2       3\n"
      "CQUAD4  5       1       1       2       3       4\n"
      "CBAR    6       1       1       2       3\n"
      "CONROD  7       3       4       1\n"
      "CBEAM3  8       1       1       2       3\n"
      "CTETRA  9       1       1       2       3       4\n"
      "CQUAD   10      1       1       2       3       4       5       6\n+       7       8       9\n"
      "CONM2   11      5       0       1.\n"
      "CTRIA6  12      1       1       2       3       4               6\n"
      "CHEXA   13      1       1       2       3       4       5       6\n"
      "+       7       8       9       10      11      12      13      14\n"
      "+       15      16      17      18      19      20\n"
      "CPENTA  14      1       1       2       3       4       5       6\n"
      "+       7       8       9       10      11      12      13      14\n+       15\n"
      "CQUAD9  15      1       1       2       3       4       5       6\n+       7       8       9\n";
  const MeshDocument document = bdf.read(nodes + cards);
  const std::vector<std::pair<std::uint8_t, std::vector<std::int32_t>>> expected{
      {cell_type::quadratic_triangle, {0, 1, 2, 3, 4, 5}},
      {cell_type::quadratic_quad, {0, 1, 2, 3, 4, 5, 6, 7}},
      {cell_type::quadratic_triangle, {0, 2, 4, 1, 3, 5}},
      {cell_type::triangle, {0, 1, 2}},
      {cell_type::quad, {0, 1, 2, 3}},
      {cell_type::line, {0, 1}},
      {cell_type::line, {2, 3}},
      {cell_type::quadratic_edge, {0, 1, 2}},
      {cell_type::tetrahedron, {0, 1, 2, 3}},
      {cell_type::biquadratic_quad, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
      {cell_type::vertex, {4}},
      {cell_type::poly_vertex, {0, 1, 2, 3, 5}},
      {cell_type::quadratic_hexahedron, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}},
      {cell_type::quadratic_wedge, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}},
      {cell_type::biquadratic_quad, {0, 1, 2, 3, 4, 5, 6, 7, 8}}};
  REQUIRE(document.cells.size() == expected.size());
  for (std::size_t cell = 0; cell < expected.size(); ++cell) {
    CAPTURE(cell);
    CHECK(document.cells.types[cell] == expected[cell].first);
    const auto vertices = document.cells[cell];
    CHECK(std::vector<std::int32_t>(vertices.begin(), vertices.end()) == expected[cell].second);
  }
  CHECK(properties_of(document) == std::vector<std::int64_t>{1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1});
  CHECK(std::ranges::count_if(document.notes, [](const std::string& note) {
          return note.find("left out of elements 'CTRIA6'") != std::string::npos;
        }) == 1);
  // Written anew, the cells that there are cards for are the same.
  MeshDocument anew = document;
  anew.original = nullptr;
  const MeshDocument again = bdf.read(bdf.written(anew));
  std::vector<std::uint8_t> types = document.cells.types;
  std::erase_if(types, [](std::uint8_t type) { return type == cell_type::vertex || type == cell_type::poly_vertex; });
  CHECK(again.cells.types == types);
  std::size_t next = 0;
  for (const auto& [type, nodes_of_cell] : expected) {
    if (type != cell_type::vertex && type != cell_type::poly_vertex) {
      const auto vertices = again.cells[next++];
      CHECK(std::vector<std::int32_t>(vertices.begin(), vertices.end()) == nodes_of_cell);
    }
  }
}

TEST_CASE("Nastran: what constraints and loads name is a set of points, with the number of their set") {
  const MeshDocument document = bdf.read(
      small_plate + small_triangles +
      "GRID    8               9.      9.      9.              1236\n"
      "SPC1    3       123     1       THRU    3\nSPC1,3,12,5,77\nSPC,4,2,123,0.,4,3\nSPCD,4,1,1,.5\n"
      "FORCE   5       3       0       1.      1.\nMPC     6       1       1       1.      2       1       -1.\n"
      "+               3       1       1.\nRBE2    99      1       123     2       3       4.5\n"
      "RBE3    98              5       123     1.      123     1       2       3.\n+       1       4\n"
      "CELAS2  97      1.5     2       1\n");
  CHECK(document.point_sets == std::vector<NamedSet>{{"CELAS2", {1}},
                                                     {"FORCE 5", {2}},
                                                     {"GRID 1236", {5}},
                                                     {"MPC 6", {0, 1, 2}},
                                                     {"RBE2", {0, 1, 2}},
                                                     {"RBE3", {0, 1, 3, 4}},
                                                     {"SPC 4", {1, 3}},
                                                     {"SPC1 3", {0, 1, 2, 4}},
                                                     {"SPCD 4", {0}}});
}

TEST_CASE("Nastran: rigid elements, pressures and coordinate systems of every kind hold the nodes that they name") {
  const std::vector<std::pair<std::string, NamedSet>> cards{
      {"RBAR1,901,1,5,123456\n", {"RBAR1", {0, 4}}},
      {"RJOINT,901,1,5,123456\n", {"RJOINT", {0, 4}}},
      {"RTRPLT,901,1,2,5,123456\n", {"RTRPLT", {0, 1, 4}}},
      {"RTRPLT1,901,1,2,5,123456\n", {"RTRPLT1", {0, 1, 4}}},
      {"RBE1,901,1,123,3,456,,,,+\n+,UM,5,12,2,3\n", {"RBE1", {0, 1, 2, 4}}},
      {"RSPLINE,901,.1,1,2,,3,123,5,+\n+,,4\n", {"RSPLINE", {0, 1, 2, 3, 4}}},
      {"RSSCON,901,GRID,1,2,5\n", {"RSSCON", {0, 1, 4}}},
      {"SPCR,6,1,3,1.,5,1,2.\n", {"SPCR 6", {0, 4}}},
      {"SLOAD,6,1,3.,5,1.\n", {"SLOAD 6", {0, 4}}},
      {"BNDGRID,123,1,THRU,3\n", {"BNDGRID", {0, 1, 2}}},
      {"TEMPBC,6,STAT,20.,1,21.,5\n", {"TEMPBC 6", {0, 4}}},
      {"QHBDY,6,AREA4,1.,.1,1,2,5\n", {"QHBDY 6", {0, 1, 4}}},
      {"CHBDYP,6,7,LINE,,,1,2\n", {"CHBDYP", {0, 1}}},
      {"ACCEL1,6,0,1.,0.,0.,1.,,,+\n+,1,THRU,2\n", {"ACCEL1 6", {0, 1}}},
      {"PLOAD,6,1.,1,2,5\n", {"PLOAD 6", {0, 1, 4}}},
      {"TEMP,6,1,20.,5,21.\n", {"TEMP 6", {0, 4}}},
      {"DAREA,6,1,3,1.,5,1,2.\n", {"DAREA 6", {0, 4}}},
      {"CORD1R,7,1,2,5\n", {"CORD1R", {0, 1, 4}}},
      {"CORD1C,7,1,2,5,8,3,4,5\n", {"CORD1C", {0, 1, 2, 3, 4}}},
  };
  for (const auto& [card, set] : cards) {
    CAPTURE(card);
    CHECK(bdf.read(small_plate + small_triangles + card).point_sets == std::vector<NamedSet>{set});
  }
  CHECK(bdf.read(small_plate + small_triangles + "RSSCON,901,ELEM,1,2,4\n").point_sets.empty());
}

TEST_CASE("Nastran: comments of preprocessors name properties") {
  const auto names = [](const std::string& comments) {
    return find_array(bdf.read(comments + small_plate + small_triangles).cell_arrays, "nastran:pid")->description;
  };
  const std::vector<ValueName> both{{7, 2, "a steel"}, {9, 2, "air"}};
  for (const std::string comments :
       {"$HMNAME COMP                   7\"x\"\n$HMNAME PROP                   7\"a steel\" 4\n$HMNAME PROP 9\"air\"\n",
        "$HMNAME COMP                   7\"a steel\"\n$HMNAME COMP                   9\"air\" 9 \"air\" 4\n",
        "$ Femap with NX Nastran Property 7 : a steel\n$ FEMAP Property 9 : air \n",
        "$ Elements and Element Properties for region : a steel\nPSHELL,7,1,.1\n"
        "$ Elements and Element Properties for region : air\n$ a\nPARAM,POST,0\nPSHELL  9       1       .1\n"}) {
    CAPTURE(comments);
    REQUIRE(names(comments) != nullptr);
    CHECK(names(comments)->value_names == both);
  }
  for (const std::string comments : {"", "$HMNAME PROP\n", "$HMNAME PROP 7 a\n", "$ Femap Property x : a\n"}) {
    CHECK(names(comments) == nullptr);
  }
}

TEST_CASE("Nastran: nodes of one rectangular system are taken as they are in it") {
  const std::string local = replace_all(small_plate, "               ", "       3       ");
  const std::string system =
      "CORD2R  3               0.      0.      0.      0.      0.      1.\n+       1.      0.      0.\n";
  const std::string text = local + small_triangles + system;
  const MeshDocument document = bdf.read(text);
  CHECK(document.points == plate_points);
  CHECK(document.notes.back() == "All nodes are in the coordinate system 3: the mesh is taken as it is in that.");
  CHECK(bdf.written(document) == text);
  const MeshDocument by_default = bdf.read("GRDSET,,3\nCORD1R,9,1,2,3,3,1,2,4\n" + small_plate + small_triangles);
  CHECK(by_default.points == plate_points);
  CHECK(by_default.notes.back() == document.notes.back());
}

TEST_CASE("Nastran: a mesh of nothing is written and read back") {
  const std::string empty = "BEGIN BULK\nENDDATA\n";
  const MeshDocument document = bdf.read(empty);
  CHECK(document.points.empty());
  CHECK(document.cells.size() == 0);
  CHECK(bdf.written(document) == empty);
  CHECK(bdf.read(bdf.written(MeshDocument{})).points.empty());
}

TEST_CASE("Nastran: what is wrong is said with its line") {
  struct Fault {
    std::string text;
    std::string message;
  };
  const std::string plate = small_plate + small_triangles;
  for (const Fault& fault :
       {Fault{"", "mesh.bdf: is not a Nastran mesh: it has no GRID"},
        {"BEGIN BULK\n", "mesh.bdf: is not a Nastran mesh: it has no GRID"},
        {"CTRIA3,1,1,1,2,3\n", "mesh.bdf: is not a Nastran mesh: it has no GRID"},
        {replace_all(plate, "2.      2.  ", "2.      2,  "), "mesh.bdf:3: "},
        {replace_all(plate, "2.      2.  ", "2.      2x  "),
         "mesh.bdf:3: expected X2 of a node (a finite number), got '2x'"},
        {replace_all(plate, "2.      2.  ", "2.      nan "),
         "mesh.bdf:3: expected X2 of a node (a finite number), got 'nan'"},
        {replace_all(plate, "2.      2.  ", "2.      1.+999"),
         "mesh.bdf:3: expected X2 of a node (a finite number), got '1.+999'"},
        {replace_all(plate, "GRID    3 ", "GRID    x "), "mesh.bdf:3: expected the number of a node, got 'x'"},
        {replace_all(plate, "GRID    3 ", "GRID      "),
         "mesh.bdf:3: expected the number of a node, got a blank field"},
        {replace_all(plate, "GRID    3 ", "GRID    2 "), "mesh.bdf:3: there is a node 2 before this one"},
        {replace_all(plate, "GRID    3         ", "GRID    3       2 "),
         "mesh.bdf:3: this node's coordinates are in the system 2, those before it in 0: "},
        {"GRDSET,,2\n" + plate,
         "mesh.bdf:2: the coordinates of the nodes are in the system 2, which no CORD1R or CORD2R of the file states"},
        {replace_all(plate, "3       4       5", "3       4       6"),
         "mesh.bdf:8: the element names node 6, which has no GRID"},
        {replace_all(plate, "3       4       5", "3       4"), "mesh.bdf:8: CTRIA3 has 3 corners, this one names 2"},
        {replace_all(plate, "3       4       5", "3       4       5."),
         "mesh.bdf:8: expected a node of CTRIA3, got '5.'"},
        {replace_all(plate, "3       9  ", "3       a  "), "mesh.bdf:8: expected the number of a property, got 'a'"},
        {"+       1.\n" + plate, "mesh.bdf:1: this line goes on with a card, but there is none before it"},
        {plate + "=,*(1),=,*(1.)\n", "mesh.bdf:10: cards that repeat the one before (=) are not read"},
        {"GRID 1 0 0. 0. 0.\n", "mesh.bdf:1: "},
        {"SOL 101\nCEND\nBEGIN BULK\n" + plate + "BEGIN SUPER=1\n",
         "mesh.bdf:13: another section of bulk data begins here"},
        {"CQUAD8  1       1       1       2       3       4       5       6       +A\n" + plate,
         "mesh.bdf:1: expected this card to go on in the next line with '+A'"},
        {"CQUAD8  1       1       1       2       3       4       5       6       +A\n+B      7       8\n" + plate,
         "mesh.bdf:1: expected this card to go on in the next line with '+A', got '+B'"},
        {"GRID*   9                               1.              1.              *A\n" + plate,
         "mesh.bdf:1: expected this card to go on in the next line with '*A'"},
        {"GRID*   9                               1.              1.\n+       1.\n" + plate,
         "mesh.bdf:1: the second line of this GRID is not in large field, as the first one is"},
        {plate + "INCLUDE 'none.bdf'\n", "mesh.bdf:10: the file 'none.bdf' that is included here cannot be read"},
        {plate + "include 'none.bdf\n",
         "mesh.bdf:10: the name of the file that is included here has no end: expected another '"},
        {plate + "INCLUDE mesh.bdf\n", "mesh.bdf:10: the file 'mesh.bdf' is included in itself"}}) {
    CAPTURE(fault.text);
    CHECK_THAT(bdf.failure_of(fault.text), Catch::Matchers::StartsWith(fault.message));
  }
}

TEST_CASE("Nastran: an included file stays as it is, and comes in where its nodes move") {
  const ScratchFolder folder;
  const std::string nodes = "$ nodes\r\n" + replace_all(free_plate, "\n", "\r\n") + "ENDDATA";
  const std::string text = "SOL 101\nCEND\nBEGIN BULK\nINCLUDE 'no\n   des.dat' $ here\n" + small_triangles;
  folder.write("nodes.dat", "\xEF\xBB\xBF" + replace_all(nodes, "ENDDATA", "$ end"));
  MeshDocument document = read_mesh(folder.write("mesh.bdf", text + "ENDDATA\n"));
  CHECK(document.points == plate_points);
  CHECK(document.cells.connectivity == plate_triangles);
  write_mesh(folder / "same.bdf", document);
  CHECK(bytes_of(folder / "same.bdf") == text + "ENDDATA\n");
  const std::string within =
      "SOL 101\nCEND\nBEGIN BULK\n" + replace_all(nodes, "ENDDATA", "$ end") + "\n" + small_triangles;
  CHECK(bdf.written(document) == within + "ENDDATA\n");
  document.points[12] = 1;
  write_mesh(folder / "moved.bdf", document);
  CHECK(bytes_of(folder / "moved.bdf") == replace_all(within, ".75", "1.") + "ENDDATA\n");
  // The end of the data is the end wherever it stands.
  folder.write("nodes.dat", nodes);
  CHECK(read_mesh(folder.write("mesh.bdf", small_triangles + "INCLUDE 'nodes.dat'\nGRID,6,9\n")).points ==
        plate_points);
}

TEST_CASE("Nastran: a mesh of another format is written in large field, with its groups as properties") {
  MeshDocument document;
  document.points = {0, 0, 1, 1.0 / 3, 0, 1, 1, -1e-9, 1};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::vertex, std::vector<std::int32_t>{0});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{1, 2});
  document.cells.append(cell_type::polygon, std::vector<std::int32_t>{0, 1, 2, 1, 0});
  auto groups = make_data_array("gmsh:physical", 1, std::vector<std::int32_t>{4, 1, 4, 0, 4});
  trismooth::ArrayDescription names;
  names.value_names = {{4, 2, "sand and clay"}, {4, 1, "a \"wall\""}};
  groups.description = std::make_shared<const trismooth::ArrayDescription>(names);
  document.cell_arrays = {groups, make_data_array("heat", 1, std::vector<double>{1, 2, 3, 4, 5})};
  document.point_sets = {{"inlet", {0, 1}}};
  const std::string written = bdf.written(document);
  CHECK(written ==
        "$ written by trismooth\nBEGIN BULK\n$HMNAME PROP                       4\"sand and clay\"\n"
        "GRID*   1                               0.              0.\n*       1.\n"
        "GRID*   2                               .3333333333333330.\n*       1.\n"
        "GRID*   3                               1.              -1.-9\n*       1.\n"
        "CTRIA3  1       4       1       2       3       \nCROD    2       1       1       2       \n"
        "CROD    3       2       2       3       \nENDDATA\n");
  const std::string unnamed =
      "Nastran has names of properties in comments, of lines, faces and solids, without quotation marks: not written "
      "are a \"wall\"";
  CHECK(what_is_lost(document, FileFormat::nastran) ==
        std::vector<std::string>{
            "Nastran holds lines, faces and solids only: 1 cell of type vertex, 1 cell of type polygon are not written",
            "Nastran holds no cell arrays: heat is not written",
            "Nastran holds no sets of points: inlet is not written", unnamed,
            "Nastran numbers properties from 1 to 99999999, each of one dimension: changed are a \"wall\" 4 (as 1)"});
  const MeshDocument again = bdf.read(written);
  CHECK(properties_of(again) == std::vector<std::int64_t>{4, 1, 2});
  CHECK(find_array(again.cell_arrays, "nastran:pid")->description->value_names ==
        std::vector<ValueName>{{4, 2, "sand and clay"}});
}

}  // namespace trismooth::nastran_test

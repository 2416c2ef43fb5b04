// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/says.h"
#include "support/text_format.h"

namespace trismooth::unv_test {

const TextFormat unv(".unv");

const std::string plate_nodes =
    "    -1\n  2411\n"
    "         1         1         1        11\n"
    "   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n"
    "         2         1         1        11\n"
    "   2.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n"
    "         3         1         1        11\n"
    "   2.0000000000000000D+00   2.0000000000000000D+00   0.0000000000000000D+00\n"
    "         4         1         1        11\n"
    "   0.0000000000000000D+00   2.0000000000000000D+00   0.0000000000000000D+00\n"
    "         5         1         1        11\n"
    "   7.5000000000000000D-01   1.2500000000000000D+00   0.0000000000000000D+00\n"
    "    -1\n";

const std::string plate_elements =
    "    -1\n  2412\n"
    "        11        91         1         0         7         3\n         1         2         5\n"
    "        12        41         1         0         7         3\n         2         3         5\n"
    "        13        51         2         0         7         3\n         3         4         5\n"
    "        14        81         2         0         7         3\n         4         1         5\n"
    "        15        21         3         0         7         2\n         0         0         0\n"
    "         1         2\n"
    "    -1\n";

const std::string plate_groups =
    "    -1\n  2467\n"
    "         4         0         0         0         0         0         0         3\n"
    "steel core\n"
    "         8        11         0         0         8        12         0         0\n"
    "         8        15         0         0\n"
    "         6         0         0         0         0         0         0         2\n"
    "air\n"
    "         8        13         0         0         8        14         0         0\n"
    "         7         0         0         0         0         0         0         2\n"
    "upper half\n"
    "         8        12         0         0         8        13         0         0\n"
    "         9         0         0         0         0         0         0         2\n"
    "supports\n"
    "         7         1         0         0         7         2         0         0\n"
    "    -1\n";

const std::string plate = plate_nodes + plate_elements + plate_groups;
const std::vector<double> plate_points{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0};

TEST_CASE("UNV: nodes, elements of all families and groups are read, and written back byte for byte") {
  const MeshDocument document = unv.read(plate);
  CHECK(document.format == FileFormat::unv);
  CHECK(document.points == plate_points);
  CHECK(document.cells.types == std::vector<std::uint8_t>{5, 5, 5, 5, cell_type::line});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 1});
  CHECK(values_of<std::int64_t>(document.cell_arrays, "unv:group") == std::vector<std::int64_t>{4, 7, 6, 6, 4});
  CHECK(find_array(document.cell_arrays, "unv:group")->description->value_names ==
        std::vector<ValueName>{{4, 1, "steel core"}, {4, 2, "steel core"}, {6, 2, "air"}, {7, 2, "upper half"}});
  CHECK(values_of<std::int64_t>(document.cell_arrays, "unv:pid") == std::vector<std::int64_t>{1, 1, 2, 2, 3});
  // Groups of which smaller ones have cells.
  CHECK(document.cell_sets == std::vector<NamedSet>{{"steel core", {0, 1, 4}}, {"upper half", {1, 2}}});
  CHECK(document.point_sets == std::vector<NamedSet>{{"supports", {0, 1}}});
  CHECK(document.notes.empty());
  CHECK(unv.written(document) == plate);
}

TEST_CASE("UNV: text between data sets is kept, and named; numbers there are a data set without its -1") {
  const std::string text = plate_nodes + "Written by a program,\n  on Monday\n\n" + plate_elements + "end of file\n";
  const MeshDocument document = unv.read(text);
  CHECK(document.points == unv.read(plate_nodes + plate_elements).points);
  CHECK(document.cells.size() == 5);
  CHECK(document.notes == std::vector<std::string>{"Text between the data sets is kept in UNV output only."});
  CHECK(unv.written(document) == text);
  const std::string without_begin = plate_elements.substr(plate_elements.find("  2412"));
  CHECK(says(unv.failure_of(plate_nodes + without_begin), "expected a line with -1"));
}

TEST_CASE("UNV: numbers of moved nodes stand in the columns of the old ones") {
  MeshDocument document = unv.read(plate);
  document.points[12] = -1.0 / 3;
  document.points[13] = 1e-100;
  std::string expected = plate;
  expected = replace_all(expected, "   7.5000000000000000D-01   1.2500000000000000D+00",
                         "  -3.3333333333333331D-01  1.0000000000000000D-100");
  CHECK(unv.written(document) == expected);
  CHECK(unv.read(expected).points == document.points);
}

TEST_CASE("UNV: exponents keep their letter, and numbers in fewer columns get more") {
  for (const char* const letter : {"E", "e", "d"}) {
    MeshDocument document = unv.read(replace_all(plate, "D+00", letter + std::string("+00")));
    document.points[3] = 1.5;
    CHECK(unv.written(document).find("\n   1.5000000000000000" + std::string(letter) + "+00   0.0") !=
          std::string::npos);
  }
  MeshDocument document =
      unv.read(replace_all(plate, "11\n   2.0000000000000000D+00   0.0000000000000000D+00", "11\n2. 0"));
  document.points[3] = 1.5;
  document.points[4] = -2;
  const std::string written = unv.written(document);
  CHECK(written.find("\n1.5000000000000000E+00 -2.0000000000000000E+00   0.0") != std::string::npos);
  CHECK(unv.read(written).points == document.points);
}

TEST_CASE("UNV: the data sets of before are read likewise") {
  std::string old = replace_all(replace_all(plate_nodes + plate_elements, "2411", " 781"), "2412", " 780");
  for (const std::string property : {"1", "2", "3"}) {
    old = replace_all(old, "         " + property + "         0         7",
                      "         0         " + property + "         0         0         7");
  }
  const MeshDocument document = unv.read(old);
  CHECK(document.points == plate_points);
  CHECK(values_of<std::int64_t>(document.cell_arrays, "unv:pid") == std::vector<std::int64_t>{1, 1, 2, 2, 3});
  CHECK(unv.written(document) == old);
  for (const char* const groups : {"2435", "2452", "2477"}) {
    CHECK(unv.read(replace_all(plate, "2467", groups)).point_sets.size() == 1);
  }
}

TEST_CASE("UNV: a group of all cells tells no regions apart, wherever it stands") {
  const std::string all =
      "         1         0         0         0         0         0         0         5\nall\n"
      "         8        11         0         0         8        12         0         0\n"
      "         8        13         0         0         8        14         0         0\n"
      "         8        15         0         0\n";
  const std::string materials =
      "         4         0         0         0         0         0         0         2\nsteel\n"
      "         8        11         0         0         8        12         0         0\n"
      "         6         0         0         0         0         0         0         2\nair\n"
      "         8        13         0         0         8        14         0         0\n";
  for (const std::string& groups : {all + materials, materials + all}) {
    const MeshDocument document = unv.read(plate_nodes + plate_elements + "    -1\n  2467\n" + groups + "    -1\n");
    CHECK(values_of<std::int64_t>(document.cell_arrays, "unv:group") == std::vector<std::int64_t>{4, 4, 6, 6, 1});
    CHECK(document.cell_sets == std::vector<NamedSet>{{"all", {0, 1, 2, 3, 4}}});
  }
}

TEST_CASE("UNV: groups that share a number are told apart") {
  const auto groups_of = [](const std::string& groups) {
    return unv.read(plate_nodes + plate_elements + "    -1\n  2477\n" + groups + "    -1\n");
  };
  // Lines and faces have numbers of their own, in Gmsh.
  const std::string rim = " 4 0 0 0 0 0 0 1\nrim\n 8 15 0 0\n";
  const std::string steel = " 4 0 0 0 0 0 0 2\nsteel\n 8 11 0 0 8 12 0 0\n";
  const std::string air = " 4 0 0 0 0 0 0 2\nair\n 8 13 0 0 8 14 0 0\n";
  const MeshDocument document = groups_of(rim + steel + air);
  CHECK(values_of<std::int64_t>(document.cell_arrays, "unv:group") == std::vector<std::int64_t>{4, 4, 1, 1, 4});
  CHECK(find_array(document.cell_arrays, "unv:group")->description->value_names ==
        std::vector<ValueName>{{4, 1, "rim"}, {4, 2, "steel"}, {1, 2, "air"}});
  CHECK(document.cell_sets.empty());
  const std::string largest = "9223372036854775807 0 0 0 0 0 0 1\n";
  CHECK(values_of<std::int64_t>(groups_of(largest + "a\n 8 11 0 0\n" + largest + "b\n 8 12 0 0\n").cell_arrays,
                                "unv:group") ==
        std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::max(), 1, 0, 0, 0});
}

TEST_CASE("UNV: groups of older data sets list pairs, and members may stand a line each") {
  const std::string pairs =
      " 4 0 0 0 0 0 0 5\nsteel\n 8 11 8 12 7 1 7 2\n 8 15\n"
      " 6 0 0 0 0 0 0 1\nair\n 8 13\n";
  for (const char* const number : {"2417", "2429", "2430", "2432"}) {
    const std::string text = plate_nodes + plate_elements + "    -1\n  " + number + "\n" + pairs + "    -1\n";
    const MeshDocument document = unv.read(text);
    CHECK(values_of<std::int64_t>(document.cell_arrays, "unv:group") == std::vector<std::int64_t>{4, 4, 6, 0, 4});
    CHECK(document.point_sets == std::vector<NamedSet>{{"steel", {0, 1}}});
    CHECK(unv.written(document) == text);
  }
  const std::string lines = replace_all(plate, "         8        11         0         0         8        12",
                                        "         8        11         0         0\n         8        12");
  CHECK(unv.read(lines).cell_sets == unv.read(plate).cell_sets);
  CHECK(unv.failure_of(replace_all(plate, "8        15         0         0\n", "8        15         0\n")) ==
        "mesh.unv:33: expected a number of a member of a group, got the end of the line");
}

TEST_CASE("UNV: nodes along the sides of an element are corners first in a cell, and go back the same way") {
  std::string text = "    -1\n  2411\n";
  for (int i = 1; i <= 20; ++i) {
    text += std::to_string(i) + " 1 1 11\n" + std::to_string(i) + " 0 0\n";
  }
  text +=
      "    -1\n    -1\n  2412\n1 92 1 0 7 6\n1 2 3 4 5 6\n2 95 1 0 7 8\n1 2 3 4 5 6 7 8\n"
      "3 94 1 0 7 9\n1 2 3 4 5 6 7 8\n9\n4 24 1 0 7 3\n0 0 0\n1 2 3\n"
      "5 118 1 0 7 10\n1 2 3 4 5 6 7 8\n9 10\n6 116 1 0 7 20\n1 2 3 4 5 6 7 8\n9 10 11 12 13 14 15 16\n17 18 19 20\n"
      "    -1\n";
  MeshDocument document = unv.read(text);
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::quadratic_triangle, cell_type::quadratic_quad,
                                                          cell_type::biquadratic_quad, cell_type::quadratic_edge,
                                                          cell_type::quadratic_tetrahedron,
                                                          cell_type::quadratic_hexahedron});
  const auto cell = [&document](std::size_t i) {
    const auto vertices = document.cells[i];
    return std::vector<std::int32_t>(vertices.begin(), vertices.end());
  };
  CHECK(cell(0) == std::vector<std::int32_t>{0, 2, 4, 1, 3, 5});
  CHECK(cell(1) == std::vector<std::int32_t>{0, 2, 4, 6, 1, 3, 5, 7});
  // As Gmsh writes it.
  CHECK(cell(2) == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(cell(3) == std::vector<std::int32_t>{0, 2, 1});
  CHECK(cell(4) == std::vector<std::int32_t>{0, 2, 4, 9, 1, 3, 5, 6, 7, 8});
  const std::vector<std::int32_t> before = document.cells.connectivity;
  const std::vector<std::uint8_t> types = document.cells.types;
  document.original = nullptr;
  const MeshDocument again = unv.read(unv.written(document));
  CHECK(again.cells.connectivity == before);
  CHECK(again.cells.types == types);
}

TEST_CASE("UNV: elements that are not known hold their nodes, and a note says which") {
  const std::string masses = replace_all(
      plate_elements, "    -1\n  2412\n",
      "    -1\n  2412\n         8       161         1         0         7         1\n         5\n"
      "         9        43         1         0         7        10\n"
      "         1         2         3         4         5         1         2         3\n         4         5\n");
  const MeshDocument document = unv.read(plate_nodes + masses);
  CHECK(document.cells.types.front() == cell_type::poly_vertex);
  CHECK(document.cells[1].size() == 10);
  CHECK(document.notes == std::vector<std::string>{"Elements of descriptors that are not known hold their nodes: 43 "
                                                   "with 10 nodes, 161 with 1 node."});
  CHECK(unv.written(document) == plate_nodes + masses);
}

TEST_CASE("UNV: what others say is kept, and named") {
  const std::string text = "    -1\n   164\n         1  SI: Meter (newton)         2\n  1.0D+00\n    -1\n" + plate +
                           "    -1\n    55\nstresses\n -1 0.5\n    -1\n";
  const MeshDocument document = unv.read(text);
  CHECK(document.notes == std::vector<std::string>{"What the data sets 164, 55 say is kept in UNV output only."});
  CHECK(unv.written(document) == text);
  CHECK(unv.read(replace_all(plate, "8        15", "8        16")).notes ==
        std::vector<std::string>{"Groups name nodes or elements that are not in the file: steel core."});
  CHECK(unv.read(replace_all(plate, "7         1         0         0         7",
                             "3         1         0         0         7"))
            .notes ==
        std::vector<std::string>{"Members of groups that are neither nodes nor elements are kept in UNV output only."});
}

TEST_CASE("UNV: coordinates in a round system are refused, those in a rectangular one are taken as they are") {
  const auto system = [](int label, int kind) {
    std::string text =
        "    -1\n  2420\n         1\na part\n" + std::to_string(label) + " " + std::to_string(kind) + " 8\na system\n";
    for (int row = 0; row < 4; ++row) {
      text += " 1.0D+00 0.0D+00 0.0D+00\n";
    }
    return text + "    -1\n";
  };
  CHECK(unv.read(system(1, 0) + plate).points == plate_points);
  CHECK(unv.read(system(7, 1) + plate).points == plate_points);
  CHECK(unv.failure_of(system(1, 1) + plate) ==
        "mesh.unv:14: the node's coordinates are in the system 1, which is cylindrical or spherical; write them in a "
        "rectangular one");
  CHECK(unv.failure_of(plate + system(1, 2)).find("mesh.unv:3: the node's coordinates") == 0);
  CHECK(unv.failure_of(system(7, 0) +
                       replace_all(plate, "3         1         1        11", "3         7         1        11"))
            .find("mesh.unv:18: this node's coordinates are in the system 7, those before it in 1") == 0);
}

TEST_CASE("UNV: a mesh from elsewhere is written with its groups and sets under their names") {
  MeshDocument document;
  document.points = plate_points;
  document.cells = unv.read(plate).cells;
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<std::int32_t>{1, 1, 2, 2, 3}));
  document.cell_sets.push_back({"both", {1, 2}});
  document.point_sets.push_back({"supports", {0, 1}});
  const std::string written = unv.written(document);
  CHECK(written.starts_with(plate_nodes));
  const MeshDocument again = unv.read(written);
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(values_of<std::int64_t>(again.cell_arrays, "unv:group") == std::vector<std::int64_t>{1, 1, 2, 2, 3});
  CHECK(again.cell_sets == document.cell_sets);
  CHECK(again.point_sets == document.point_sets);
  CHECK(what_is_lost(document, FileFormat::unv).empty());
  document.cells.append(cell_type::pyramid, std::vector<std::int32_t>{0, 1, 2, 3, 4});
  document.cell_arrays.clear();
  CHECK(what_is_lost(document, FileFormat::unv) ==
        std::vector<std::string>{"UNV holds lines, faces and solids only: 1 cell of type pyramid is not written"});
  CHECK(unv.read(unv.written(MeshDocument{})).points.empty());
}

TEST_CASE("UNV: groups that overlap are written whole, each once and under its own number") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 2, 3});
  document.cell_arrays = {make_data_array<std::int32_t>("gmsh:physical", 1, {1, 2})};
  auto description = std::make_shared<trismooth::ArrayDescription>();
  description->value_names = {{1, 2, "steel"}, {2, 2, "all"}};
  document.cell_arrays[0].description = description;
  document.cell_sets = {{"all", {0, 1}}, {"air", {1}}};
  const MeshDocument again = unv.read(unv.written(document));
  CHECK(values_of<std::int64_t>(again.cell_arrays, "unv:group") == std::vector<std::int64_t>{1, 3});
  CHECK(again.cell_arrays.at(0).description->value_names ==
        std::vector<trismooth::ValueName>{{1, 2, "steel"}, {3, 2, "air"}});
  CHECK(again.cell_sets == std::vector<trismooth::NamedSet>{{"all", {0, 1}}});
}

TEST_CASE("UNV: what is wrong is said with its line") {
  struct Fault {
    std::string text;
    std::string message;
  };
  for (const Fault& fault :
       {Fault{"", "mesh.unv:1: is not a universal file: expected a line with -1"},
        {"    -1\n", "mesh.unv:2: expected the number of a data set, got the end of the file"},
        {"    -1\n     0\n    -1\n", "mesh.unv:2: expected the number of a data set, got '0'"},
        {plate_elements, "mesh.unv:1: is not a mesh: it has no nodes (data set 2411)"},
        {"    -1\n    15\n    -1\n",
         "mesh.unv:2: the nodes of data set 15, which is obsolete, are not read; write them"},
        {plate.substr(0, plate.size() - 8), "mesh.unv:"},
        {replace_all(plate, "1.2500000000000000D+00", "1.25x"),
         "mesh.unv:12: expected y of a node (a finite number), got '1.25x'"},
        {replace_all(plate, "1.2500000000000000D+00", "1.25D+999"),
         "mesh.unv:12: expected y of a node (a finite number), got '1.25D+999'"},
        {replace_all(plate, "D-01   1.2500000000000000D+00", "D-01"), "mesh.unv:12: expected z of a node, got the end"},
        {replace_all(plate, "1.2500000000000000D+00", "1.25 7"), "mesh.unv:12: expected the end of the line, got '0.0"},
        {replace_all(plate, "         5         1         1", "         4         1         1"),
         "mesh.unv:12: node 4 stands in the file twice"},
        {replace_all(plate, "        14        81", "        13        81"),
         "mesh.unv:22: element 13 stands in the file twice"},
        {replace_all(plate, "         4         1         5", "         4         1         6"),
         "mesh.unv:22: the element names node 6, which is none of the file"},
        {replace_all(plate, "         4         1         5", "         4         1"),
         "mesh.unv:23: expected a node of an element, got the end of the line"},
        {replace_all(plate, "81         2         0         7         3", "81         2         0         7 999999999"),
         "mesh.unv: declares 999999999 nodes of an element, but the file has room for"},
        {replace_all(plate, "0         0         2\nair", "0         0 999999999\nair"),
         "mesh.unv: declares 999999999 members of a group, but the file has room for"}}) {
    CAPTURE(fault.text);
    const std::string said = unv.failure_of(fault.text);
    CAPTURE(said);
    CHECK(said.substr(0, fault.message.size()) == fault.message);
  }
}

}  // namespace trismooth::unv_test

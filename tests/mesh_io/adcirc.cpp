// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/text_format.h"

namespace trismooth::adcirc_test {

const TextFormat adcirc(".14");

const std::string head = "a bay\n2 4 ! NE NP\n";
const std::string nodes = "1 0 0 10.5\n2 1.5 0 -2\n3 1 1 3e0\n4 0 1 0\n";
const std::string elements = "1 3 1 2 3\n2 3 1 3 4\n";
const std::string boundaries =
    "1 = Number of open boundaries\n2 = Total number of open boundary nodes\n2 = Number of nodes for open boundary 1\n"
    "1\n2\n2 = Number of land boundaries\n4 = Total\n2 20 = Number of nodes for land boundary 1\n2\n3\n1 24\n3 4 2.5 1 "
    "1\n";
const std::string bay = head + nodes + elements + boundaries;

TEST_CASE("ADCIRC: the grid is read with depths, and boundaries as sets of points") {
  for (const char* const extension : {".14", ".grd", ".gr3", ".ll", ".GRD"}) {
    const MeshDocument document = TextFormat(extension).read(bay);
    CHECK(document.format == FileFormat::adcirc);
    CHECK(document.points == std::vector<double>{0, 0, 0, 1.5, 0, 0, 1, 1, 0, 0, 1, 0});
    CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::triangle});
    CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3});
    CHECK(values_of<double>(document.point_arrays, "depth") == std::vector<double>{10.5, -2, 3, 0});
    CHECK(document.arrays_of_places == std::vector<std::string>{"depth"});
    CHECK(document.point_sets == std::vector<NamedSet>{{"open boundary 1", {0, 1}},
                                                       {"land boundary 1 (type 20)", {1, 2}},
                                                       {"weir 2 (type 24)", {2, 3}}});
    CHECK(document.notes ==
          std::vector<std::string>{"Heights and coefficients of weirs are kept in ADCIRC output only."});
  }
}

TEST_CASE("ADCIRC: the grid is the same however Fortran's input allows it to be laid out") {
  const MeshDocument plain = adcirc.read(bay);
  for (const std::string& text :
       {replace_all(bay, "\n", "\r\n"), replace_all(bay, "\n", "\r"), "\n" + bay.substr(6),
        bay.substr(0, bay.size() - 1), replace_all(bay, "4 0 1 0", "4,0,1,0"),
        replace_all(bay, "4 0 1 0", "4, 0 , 1.D0 \t,+0"), replace_all(bay, "\n2 4", "\n\n \n2,4,"),
        replace_all(bay, "1.5 0 -2\n", " 0.15D+01 0 -2 behind it\n"), replace_all(bay, "\n3 1 1", "\n\n\t3 1 1"),
        replace_all(bay, "3 4 2.5 1 1", "3,4,2.5,1,1"), replace_all(bay, "1\n2\n2 =", "1 x\n 2 2 2 2\n2 =")}) {
    CAPTURE(text);
    const MeshDocument document = adcirc.read(text);
    CHECK(document.points == plain.points);
    CHECK(document.cells.connectivity == plain.cells.connectivity);
    CHECK(values_of<double>(document.point_arrays, "depth") == values_of<double>(plain.point_arrays, "depth"));
    CHECK(document.point_sets == plain.point_sets);
    CHECK(adcirc.written(document) == text);
  }
}

TEST_CASE("ADCIRC: nodes are known by their numbers, in any order") {
  const std::string text = "\n1 4\n70 0 0 1\n-2 1 0 1\n4000000 1 1 1\n9 0 1 1\n17 4 9 4000000 -2 70\n1\n1\n1 0\n-2\n";
  const MeshDocument document = adcirc.read(text);
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::quad});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{3, 2, 1, 0});
  CHECK(document.point_sets == std::vector<NamedSet>{{"open boundary 1", {1}}});
  CHECK(adcirc.written(document) == text);
}

TEST_CASE("ADCIRC: a grid may end behind its elements or any of its lists of boundaries, or go on with other text") {
  struct Ending {
    std::string text;
    std::size_t sets;
    std::string note;
  };
  for (const Ending& ending : {Ending{"", 0, ""},
                               {"\n \n", 0, ""},
                               {"0\n0\n", 0, ""},
                               {"1\n1\n1 1\n3\n", 1, ""},
                               {"0 = Number of open boundaries\n0\n0\n0\n", 0, ""},
                               {"0\n0\n0\n0\n1 2 3 proj", 0, "boundaries"}}) {
    CAPTURE(ending.text);
    const std::string text = head + nodes + elements + ending.text;
    const MeshDocument document = adcirc.read(text);
    CHECK(document.cells.size() == 2);
    CHECK(document.point_sets.size() == ending.sets);
    CHECK(document.notes.size() == (ending.note.empty() ? 0U : 1U));
    CHECK((ending.note.empty() || document.notes.front() == "The file goes on after its " + ending.note +
                                                                "; what stands there is kept in ADCIRC output only."));
    CHECK(adcirc.written(document) == text);
  }
}

TEST_CASE("ADCIRC: a depth may be no number, which stays as it is written") {
  for (const std::string none : {"nan", "NaN", "NAN", "-nan"}) {
    CAPTURE(none);
    const std::string text = replace_all(bay, "1.5 0 -2", "1.5 0 " + none);
    MeshDocument document = adcirc.read(text);
    CHECK(std::isnan(values_of<double>(document.point_arrays, "depth").at(1)));
    CHECK(adcirc.written(document) == text);
    document.points[3] = 1.75;
    CHECK(adcirc.written(document) == replace_all(text, "1.5 0", "1.75 0"));
  }
}

TEST_CASE("ADCIRC: what is wrong is said with its line") {
  struct Fault {
    std::string text;
    std::string message;
  };
  for (const Fault& fault : {
           Fault{"", "mesh.14:1: expected the numbers of elements and nodes, got the end of the file"},
           {"a bay\n\n", "mesh.14:3: expected the numbers of elements and nodes, got the end of the file"},
           {"a bay\nx 4\n", "mesh.14:2: expected the number of elements (a whole number), got 'x'"},
           {"a bay\n2\n", "mesh.14:2: expected the number of nodes, got the end of the line"},
           {"a bay\n2 -4\n", "mesh.14:2: expected the number of nodes from 0 to 2147483647, got '-4'"},
           {replace_all(bay, "2 4 !", "2 400 !"), "mesh.14: declares 400 nodes, but the file has room for "},
           {replace_all(bay, "2 4 !", "90 4 !"), "mesh.14: declares 90 elements, but the file has room for "},
           {replace_all(bay, "3 1 1 3e0", "3 1 nan 3"), "mesh.14:5: expected y (a finite number), got 'nan'"},
           {replace_all(bay, "3 1 1 3e0", "3 1 1,5 3"),
            "mesh.14:5: numbers have a decimal point, and are separated by commas or by blanks alone, got '3 1 1,5 3'"},
           {replace_all(bay, "3 1 1 3e0", "3 1 1 3,5"),
            "mesh.14:5: numbers have a decimal point, and are separated by commas or by blanks alone, got '3 1 1 3,5'"},
           {replace_all(bay, "3 1 1 3e0", "3 1 1"), "mesh.14:5: expected the depth, got the end of the line"},
           {replace_all(bay, "3 1 1 3e0", "3,1,,1"), "mesh.14:5: expected y, got a comma"},
           {replace_all(bay, "3 1 1 3e0", "3.0 1 1 3"),
            "mesh.14:5: expected the number of a node (a whole number), got '3.0'"},
           {replace_all(bay, "4 0 1 0", "2 0 1 0"), "mesh.14:6: node 2 stands in the file twice"},
           {replace_all(bay, "2 3 1 3 4", "2 3 1 3 5"),
            "mesh.14:8: element 2 of 2 names node 5, which is none of the file"},
           {replace_all(bay, "2 3 1 3 4", "2 2 1 3"),
            "mesh.14:8: expected the number of the nodes of element 2 of 2 from 3 to 4, got '2'"},
           {replace_all(bay, "2 3 1 3 4", "2 3 1 3"),
            "mesh.14:8: expected a node of element 2 of 2, got the end of the line"},
           {replace_all(bay, "2 4 !", "1 4 !"),
            "mesh.14:8: expected the end of the elements after the declared 1, got another one"},
           {head + nodes + elements + "9000\n0\n",
            "mesh.14:9: expected the number of open boundaries, got 9000; the file has room for 1 at most"},
           {head + nodes + elements + "-1\n0\n",
            "mesh.14:9: expected the number of open boundaries from 0 to 9223372036854775807, got '-1'"},
           {head + nodes + elements + "made for a test\n",
            "mesh.14:9: expected the number of open boundaries (a whole number), got 'made'"},
           {head + nodes + elements + "1\n1\n9000\n1\n",
            "mesh.14:11: expected the number of nodes of open boundary 1, got 9000; the file has room for 1 at most"},
           {head + nodes + elements + "1\n1\n1\n7\n",
            "mesh.14:12: open boundary 1 names node 7, which is none of the file"},
           {head + nodes + elements + "0\n0\n1\n1\n1\n7\n",
            "mesh.14:13: expected the type of land boundary 1, got the end of the line"},
           {head + nodes + elements + "0\n0\n1\n1\n1 4\n1\n",
            "mesh.14:14: expected a node of land boundary 1, got the end of the line"},
           {head + nodes + elements + "1\n2\n2\n1\n \n\n",
            "mesh.14:15: expected node 2 of 2 of open boundary 1, got the end of the file"},
       }) {
    CAPTURE(fault.text);
    CHECK_THAT(adcirc.failure_of(fault.text), Catch::Matchers::StartsWith(fault.message));
  }
}

TEST_CASE("ADCIRC: a mesh of another format is written with what the grid holds, and the rest is said") {
  MeshDocument document;
  document.points = {0, 0, 0, 1.5, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 2, 3});
  document.point_arrays = {make_data_array("Depth", 1, std::vector<double>{10.5, -2, 3, 0}),
                           make_data_array("heat", 1, std::vector<double>{1, 2, 3, 4})};
  document.cell_arrays = {make_data_array("region", 1, std::vector<std::int32_t>{1, 2, 3})};
  document.point_sets = {
      {"land boundary 1 (type 20)", {1, 2}}, {"open boundary 1", {0, 1}}, {"weir 2 (type 24)", {2, 3}}, {"inlet", {0}}};
  const std::string written = adcirc.written(document);
  CHECK(written ==
        "grid\n2 4\n1 0 0 10.5\n2 1.5 0 -2\n3 1 1 3\n4 0 1 0\n1 3 1 2 3\n2 3 1 3 4\n"
        "1 = Number of open boundaries\n2 = Total number of open boundary nodes\n"
        "2 = Number of nodes for open boundary 1\n1\n2\n"
        "1 = Number of land boundaries\n2 = Total number of land boundary nodes\n"
        "2 20 = Number of nodes for land boundary 1\n2\n3\n");
  CHECK(what_is_lost(document, FileFormat::adcirc) ==
        std::vector<std::string>{
            "ADCIRC holds triangles and quadrilaterals only: 1 cell of type line is not written",
            "ADCIRC holds no point arrays: heat is not written", "ADCIRC holds no cell arrays: region is not written",
            "ADCIRC holds boundaries without heights by their names ('open boundary 1', 'land boundary 1 (type 20)'), "
            "no other sets of points: weir 2 (type 24), inlet are not written"});
  const MeshDocument again = adcirc.read(written);
  CHECK(again.points == document.points);
  CHECK(values_of<double>(again.point_arrays, "depth") == std::vector<double>{10.5, -2, 3, 0});
  CHECK(again.point_sets == std::vector<NamedSet>{document.point_sets[1], document.point_sets[0]});
}

TEST_CASE("ADCIRC output from elsewhere has quadrilaterals beside triangles, as SCHISM reads them") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0};
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 2, 3});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{1, 4, 2});
  const std::string written = adcirc.written(document);
  CHECK(written.starts_with("grid\n2 5\n"));
  CHECK(written.find("\n1 4 1 2 3 4\n2 3 2 5 3\n") != std::string::npos);
  for (const std::string& sentence : what_is_lost(document, FileFormat::adcirc)) {
    CHECK(sentence.find("quad") == std::string::npos);
  }
}

/// A square of 4 by 4 cells of two triangles without its middle four, listed one way or the other in turn, and lines.
MeshDocument pond(const std::vector<std::vector<std::int32_t>>& lines_of_groups) {
  constexpr std::int32_t side = 5;
  MeshDocument document;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      document.points.insert(document.points.end(), {static_cast<double>(x), static_cast<double>(y), 0.0});
    }
  }
  std::vector<std::int32_t> groups;
  for (std::int32_t y = 0; y + 1 < side; ++y) {
    for (std::int32_t x = 0; x + 1 < side; ++x) {
      const bool is_hole = (x == 1 || x == 2) && (y == 1 || y == 2);
      const std::int32_t a = y * side + x;
      if (!is_hole) {
        document.cells.append(cell_type::triangle, std::vector<std::int32_t>{a, a + 1, a + side + 1});
        document.cells.append(cell_type::triangle, std::vector<std::int32_t>{a, a + side, a + side + 1});
        groups.insert(groups.end(), 2, 1);
      }
    }
  }
  for (std::size_t group = 0; group < lines_of_groups.size(); ++group) {
    const std::vector<std::int32_t>& ends = lines_of_groups[group];
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      document.cells.append(cell_type::line, std::vector<std::int32_t>{ends[i], ends[i + 1]});
      groups.push_back(static_cast<std::int32_t>(group) + 1);
    }
  }
  document.cell_arrays = {make_data_array("gmsh:physical", 1, groups)};
  document.point_arrays = {make_data_array("depth", 1, std::vector<double>(25, 1.0))};
  return document;
}

void name_lines(MeshDocument& document, const std::vector<std::string>& names) {
  trismooth::ArrayDescription description;
  for (std::size_t i = 0; i < names.size(); ++i) {
    description.value_names.push_back({static_cast<std::int64_t>(i) + 1, 1, names[i]});
  }
  document.cell_arrays[0].description = std::make_shared<const trismooth::ArrayDescription>(std::move(description));
}

TEST_CASE("ADCIRC: lines of groups named open and land become boundaries with the mesh to their left") {
  // Listed in no order and direction: the lower side, what else is around the mesh, and around the hole.
  MeshDocument document =
      pond({{3, 2, 0, 1, 3, 4, 1, 2},
            {4, 9, 14, 9, 14, 19, 19, 24, 24, 23, 22, 23, 22, 21, 20, 21, 20, 15, 15, 10, 10, 5, 5, 0},
            {6, 7, 8, 7, 8, 13, 13, 18, 18, 17, 16, 17, 16, 11, 11, 6}});
  name_lines(document, {"Open sea", "LAND", "island"});
  const MeshDocument again = adcirc.read(adcirc.written(document));
  CHECK(again.point_sets ==
        std::vector<NamedSet>{{"open boundary 1", {0, 1, 2, 3, 4}},
                              {"land boundary 1 (type 0)", {4, 9, 14, 19, 24, 23, 22, 21, 20, 15, 10, 5, 0}},
                              {"land boundary 2 (type 1)", {6, 11, 16, 17, 18, 13, 8, 7}}});
  CHECK(what_is_lost(document, FileFormat::adcirc) ==
        std::vector<std::string>{"ADCIRC holds no cell arrays: gmsh:physical is not written"});
  // Around the whole mesh, in two pieces where something is between them.
  document = pond({{0, 1, 1, 2, 22, 23}});
  name_lines(document, {"land"});
  CHECK(adcirc.read(adcirc.written(document)).point_sets ==
        std::vector<NamedSet>{{"land boundary 1 (type 0)", {0, 1, 2}}, {"land boundary 2 (type 0)", {23, 22}}});
}

TEST_CASE("ADCIRC: groups of lines that can be no boundary are said, and sets of points come first") {
  struct Loss {
    std::vector<std::int32_t> lines;
    std::string name;
    std::string sentence;
  };
  for (const Loss& loss : {Loss{{0, 1, 1, 7}, "open", "which are no edges of the mesh's boundary, not all of them"},
                           {{0, 2}, "land", "which are no edges of the mesh's boundary, not all of them"}}) {
    MeshDocument document = pond({loss.lines});
    name_lines(document, {loss.name});
    const auto lost = what_is_lost(document, FileFormat::adcirc);
    CHECK(std::ranges::find(lost, "ADCIRC gets no boundary from the lines of " + loss.name + ", " + loss.sentence) !=
          lost.end());
    CHECK(adcirc.read(adcirc.written(document)).point_sets.empty());
    CHECK(lost.front().starts_with("ADCIRC holds triangles and quadrilaterals only: "));
  }
  MeshDocument document = pond({{0, 1}});
  name_lines(document, {"open"});
  document.point_sets = {{"open boundary 1", {1, 2}}};
  CHECK(adcirc.read(adcirc.written(document)).point_sets == document.point_sets);
  document = pond({{0, 1}});
  name_lines(document, {"walls"});
  CHECK(adcirc.read(adcirc.written(document)).point_sets.empty());
}

TEST_CASE("ADCIRC: depths come from elevations with the other sign, and are 0 where a mesh has none") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  const auto lost = what_is_lost(document, FileFormat::adcirc);
  CHECK(lost == std::vector<std::string>{
                    "ADCIRC holds a depth for each point: 0 is written, since there is no point array depth",
                    "ADCIRC runs with boundaries: the mesh names none, and none are written; groups of lines named "
                    "open... or land... become such"});
  CHECK(values_of<double>(adcirc.read(adcirc.written(document)).point_arrays, "depth") == std::vector<double>{0, 0, 0});
  document.point_arrays = {make_data_array("elevation", 1, std::vector<double>{-1.5, 0, 2})};
  CHECK(values_of<double>(adcirc.read(adcirc.written(document)).point_arrays, "depth") ==
        std::vector<double>{1.5, 0, -2});
  CHECK(what_is_lost(document, FileFormat::adcirc).size() == 1);
  document.points[5] = document.points[2] = document.points[8] = 2.5;
  CHECK(what_is_lost(document, FileFormat::adcirc).front() == "ADCIRC holds x and y only: z, 2.5, is not written");
}

}  // namespace trismooth::adcirc_test

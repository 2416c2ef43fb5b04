// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/su2/su2_keyword_line.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/says.h"
#include "support/text_format.h"

namespace trismooth::su2_test {

namespace type = cell_type;

const TextFormat su2(".su2");

/// Two triangles and a quad with markers of their boundary, as Gmsh writes such a mesh.
const std::string house =
    "NDIME= 2\nNELEM= 3\n5 0 1 2 0\n9 0 2 3 5 1\n5 3 2 4 2\nNPOIN= 6\n0 0 0\n1 0 1\n1 1 2\n0.5 2.5 3\n1 2 4\n0 1 5\n"
    "NMARK= 2\nMARKER_TAG= floor\nMARKER_ELEMS= 1\n3 0 1 \nMARKER_TAG= walls\nMARKER_ELEMS= 5\n3 1 2 \n3 2 4 \n3 4 3 \n"
    "3 3 5 \n3 5 0 \n";

const std::vector<double> house_points{0, 0, 0, 1, 0, 0, 1, 1, 0, 0.5, 2.5, 0, 1, 2, 0, 0, 1, 0};

std::vector<ValueName> marker_names(const MeshDocument& document) {
  const DataArray* const array = find_array(document.cell_arrays, "su2:marker");
  return array == nullptr ? std::vector<ValueName>{} : array->description->value_names;
}

void check_house(const MeshDocument& document) {
  CHECK(document.format == FileFormat::su2);
  CHECK(document.points == house_points);
  CHECK(document.cells.types == std::vector<std::uint8_t>{type::triangle, type::quad, type::triangle, type::line,
                                                          type::line, type::line, type::line, type::line, type::line});
  CHECK(document.cells.connectivity ==
        std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 5, 3, 2, 4, 0, 1, 1, 2, 2, 4, 4, 3, 3, 5, 5, 0});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "su2:marker") ==
        std::vector<std::int32_t>{0, 0, 0, 1, 2, 2, 2, 2, 2});
  CHECK(marker_names(document) == std::vector<ValueName>{{1, 1, "floor"}, {2, 1, "walls"}});
  CHECK(document.cell_arrays.size() == 1);
  CHECK(document.point_arrays.empty());
}

TEST_CASE("SU2: the mesh is the same however the file is laid out, and is written back as it was") {
  const std::size_t points = house.find("NPOIN");
  const std::size_t elements = house.find("NELEM");
  const std::size_t markers = house.find("NMARK");
  const std::string dimension = house.substr(0, elements);
  const std::string of_elements = house.substr(elements, points - elements);
  const std::string of_points = house.substr(points, markers - points);
  const std::string of_markers = house.substr(markers);
  const std::string text = GENERATE_COPY(
      as<std::string>{}, house, house.substr(0, house.size() - 2), dimension + of_points + of_elements + of_markers,
      of_points + of_elements + of_markers + dimension, replace_all(house, "= ", "="), replace_all(house, "= ", " = "),
      replace_all(house, "= ", "\t=\t"), replace_all(house, "NPOIN= 6", "NPOIN= 6 4"), replace_all(house, " ", "\t"),
      replace_all(house, "\n", "\n\n"), replace_all(house, "\n", " % NPOIN= 7\n% 1 2 3\n"),
      "\xEF\xBB\xBF% a title\n" + house, replace_all(replace_all(house, "1 2 4\n", "1 2\n"), "5 0 1 2 0", "5 0 1 2"),
      replace_all(house, "0.5 2.5 3", "+5e-1 2.50 3 0.125 7"), "a text\n" + house + "and another = one\n");
  const std::string line_end = GENERATE("\n", "\r\n", "\r");
  const std::string file = replace_all(text, "\n", line_end);
  CAPTURE(file);
  const MeshDocument document = su2.read(file);
  check_house(document);
  CHECK(document.notes.empty());
  CHECK((su2.written(document) == file));
}

TEST_CASE("SU2: zones are one mesh; points that coincide stay two; markers are known by their names") {
  const std::string zone =
      "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\nNMARK= 2\nMARKER_TAG= interface\nMARKER_ELEMS= 1\n3 0 1\n"
      "MARKER_TAG= @\nMARKER_ELEMS= 2\n3 1 2\n3 2 0\n";
  const std::string text = "NZONE= 2\nIZONE= 1\n" + fill(zone, {"inner"}) + "IZONE= 2\n" + fill(zone, {"outer"});
  MeshDocument document = su2.read(text);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 1, 1, 2, 2, 0, 3, 4, 5, 3, 4, 4, 5, 5, 3});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "su2:zone") == std::vector<std::int32_t>{1, 1, 1, 1, 2, 2, 2, 2});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "su2:marker") ==
        std::vector<std::int32_t>{0, 1, 2, 2, 0, 1, 3, 3});
  CHECK(marker_names(document) == std::vector<ValueName>{{1, 1, "interface"}, {2, 1, "inner"}, {3, 1, "outer"}});
  CHECK(su2.written(document) == text);
  document.points[9] = 0.25;
  const std::size_t second = text.rfind("\n0 0\n");
  CHECK(su2.written(document) == text.substr(0, second) + "\n0.25 0\n" + text.substr(second + 5));
}

TEST_CASE("SU2: the dimension may stand once, before the zones") {
  const std::string behind_dimension = house.substr(house.find('\n') + 1);
  const MeshDocument plain = su2.read("NZONE= 2\nIZONE= 1\n" + house + "IZONE= 2\n" + house);
  for (const std::string& text : {"NDIME= 2\nNZONE= 2\nIZONE= 1\n" + behind_dimension + "IZONE= 2\n" + behind_dimension,
                                  "NZONE= 2\n% all\nNDIME= 2\n\n% one\nIZONE= 1\n" + house + "IZONE= 2\n" + house}) {
    CAPTURE(text);
    const MeshDocument document = su2.read(text);
    CHECK(document.points == plain.points);
    CHECK(document.cells.connectivity == plain.cells.connectivity);
    CHECK(su2.written(document) == text);
  }
  check_house(su2.read("NDIME= 2\nNZONE= 1\n" + behind_dimension));
  CHECK(says(su2.failure_of("NDIME= 2\nNDIME= 2\nIZONE= 1\n" + behind_dimension), "NPOIN"));
  CHECK(says(su2.failure_of("NZONE= 1\nIZONE= 1\n" + behind_dimension), "zone 1 has no NDIME="));
}

TEST_CASE("SU2: halo points are vertex cells") {
  for (const std::string exchange : {"SEND_RECV= 1\n", "SEND_TO=-1\n", ""}) {
    const std::string text = replace_all(
        house, "NMARK= 2\n", "NMARK= 3\nMARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\n" + exchange + "1 4 0\n1 5 0\n");
    const MeshDocument document = su2.read(text);
    CHECK(std::ranges::count(document.cells.types, type::vertex) == 2);
    CHECK(marker_names(document) == std::vector<ValueName>{{1, 0, "SEND_RECEIVE"}, {2, 1, "floor"}, {3, 1, "walls"}});
    CHECK(su2.written(document) == text);
  }
}

TEST_CASE("SU2: a marker without elements keeps its name") {
  const MeshDocument document =
      su2.read(replace_all(house, "NMARK= 2\n", "NMARK= 3\nMARKER_TAG= my far field\nMARKER_ELEMS= 0\n"));
  CHECK(marker_names(document) == std::vector<ValueName>{{1, 1, "my far field"}, {2, 1, "floor"}, {3, 1, "walls"}});
}

TEST_CASE("SU2: what the file says beside its mesh is noted once, and kept") {
  const std::string text = "AOA_OFFSET= 1.5\n" + house +
                           "NPERIODIC= 1\nPERIODIC_INDEX= 0\n0 0 0\n0 0 0\n1 0 0\nNCHUNK= 2\nFFD_NBOX= 1\nFFD_TAG= a\n"
                           "FFD_CORNER_POINTS= 4\n0 0\n1 0\n1 1\n0 1\nFFD_SURFACE_POINTS= 1\nfloor 0 0.5 0.25 0\n";
  const MeshDocument document = su2.read(text);
  check_house(document);
  CHECK(document.notes ==
        std::vector<std::string>{"What the file says beside its mesh is kept in SU2 output only: AOA_OFFSET, periodic "
                                 "boundaries, NCHUNK, free-form deformation boxes."});
  CHECK(su2.written(document) == text);
}

TEST_CASE("SU2: faces in space are read with z") {
  const std::string text =
      "NDIME= 3\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0 @\n1 0 0.5\n0 1 0.5\nNMARK= 1\nMARKER_TAG= 7\nMARKER_ELEMS= 1\n5 0 1 "
      "2\n";
  MeshDocument document = su2.read(fill(text, {"0.5"}));
  CHECK(document.points == std::vector<double>{0, 0, 0.5, 1, 0, 0.5, 0, 1, 0.5});
  CHECK(marker_names(document) == std::vector<ValueName>{{1, 2, "7"}});
  document.points[2] = 0.75;
  CHECK(su2.written(document) == fill(text, {"0.75"}));
}

TEST_CASE("SU2: what breaks the rules is refused with the line and the reason") {
  const auto check = [](const std::string& from, const std::string& to, const std::string& message) {
    CAPTURE(from, to);
    CHECK(su2.failure_of(replace_all(house, from, to)) == "mesh.su2" + message);
  };
  check("NDIME= 2", "NDIME= 4", ":1: expected the dimension behind NDIME=, from 2 to 3, got '4'");
  check("NDIME= 2\n", "", ":1: the file has no NDIME=: it is cut off, or no SU2 mesh");
  check("NELEM= 3", "NELEM= 2",
        ":5: expected a keyword behind the declared elements, got '5': the number of elements is wrong");
  check("NELEM= 3", "NELEM= 4",
        ":6: element 4 of 4: expected its type, 5 (a triangle), 9 (a quadrilateral) or 3 (a line), got 'NPOIN='");
  check("NELEM= 3", "NELEM= three",
        ":2: expected the number of elements behind NELEM=, from 0 to 2147483647, got 'three'");
  check("NELEM= 3", "NELEM= 300",
        ": declares 300 elements, but the file has room for 50 at most: it is cut off, or that number is wrong");
  check("9 0 2 3 5 1", "10 0 2 3 5 1",
        ":4: element 2 of 3: a tetrahedron; meshes of solids are not read, only those of triangles and quadrilaterals");
  check("9 0 2 3 5 1", "9 0 2 3", ":4: element 2 of 3: expected 4 points behind its type, got 3");
  check("9 0 2 3 5 1", "9 0 2 3 5 1 1",
        ":4: element 2 of 3: expected the end of the line behind 4 points and a number of the element, got '1'");
  check("9 0 2 3 5 1", "9 0 2 6 5 1",
        ":4: element 2 of 3: expected a point, got '6'; the file has 6 points, counted from 0");
  check("9 0 2 3 5 1", "9 0 2 -1 5 1",
        ":4: element 2 of 3: expected a point, got '-1'; the file has 6 points, counted from 0");
  check("NPOIN= 6", "NPOIN= 5", ":4: element 2 of 3: expected a point, got '5'; the file has 5 points, counted from 0");
  check("NPOIN= 6", "NPOIN= 7", ":13: expected a coordinate (a finite number), got 'NMARK='");
  check("NPOIN= 6", "NPOIN= 6 7", ":6: expected the number of points without halo behind NPOIN=, from 0 to 6, got '7'");
  check("0.5 2.5 3", "0.5", ":10: point 4 of 6: expected 2 coordinates, got 1");
  check("0.5 2.5 3", "0.5 nan 3", ":10: expected a coordinate (a finite number), got 'nan'");
  check("0.5 2.5 3", "0.5 2.5 three",
        ":10: point 4 of 6: expected a number or the end of the line behind the coordinates, got 'three'");
  check("NMARK= 2\n", "", ":22: the file has no NMARK=: it is cut off, or no SU2 mesh");
  check("NMARK= 2", "NMARK= 3",
        ":23: NMARK= declares 3 markers, but the file has 2: it is cut off, or that number is wrong");
  check("NMARK= 2", "NMARK= 1",
        ":23: NMARK= declares 1 markers, but the file has 2: it is cut off, or that number is wrong");
  check("3 0 1 \n", "5 0 1 2\n", ":16: element 1 of 1: expected its type, 3 (a line) or 1 (a point), got '5'");
  check("3 0 1 \n", "3 0 1\n3 1 2\n",
        ":17: expected a keyword behind the declared elements of the marker, got '3': the number of elements of the "
        "marker is wrong");
  check("MARKER_TAG= floor\n", "", ":14: MARKER_ELEMS= stands without a MARKER_TAG= before it");
  check("MARKER_TAG= floor", "MARKER_TAG= ", ":14: expected the marker's name behind MARKER_TAG=");
  check("MARKER_ELEMS= 1\n3 0 1 \n", "", ":15: the marker 'floor' has no MARKER_ELEMS=");
  check("NMARK= 2", "NMARK= 2\nNMARK= 2", ":14: NMARK= stands twice");
  check("NDIME= 2", "NZONE= 2\nNDIME= 2", ": NZONE= declares 2 zones, the file has 1");
  check("NMARK= 2", "IZONE= 1\nNMARK= 2", ":13: IZONE= stands behind sections of a mesh that are in no zone");
  CHECK(su2.failure_of("") == "mesh.su2: has no NDIME=: it is no SU2 mesh, or is cut off");
  const std::string zone = "IZONE= 1\nNDIME= 2\nNELEM= 0\nNPOIN= 0\nNMARK= 0\n";
  CHECK(su2.failure_of("NZONE= 1\n" + replace_all(zone, "IZONE= 1", "IZONE= 2")) ==
        "mesh.su2:2: zone 2 is none of the 1 that NZONE= declares");
  CHECK(su2.failure_of(zone + zone) == "mesh.su2:6: zone 1 stands in the file twice");
  CHECK(su2.failure_of(zone + replace_all(replace_all(zone, "1", "2"), "NDIME= 2", "NDIME= 3")) ==
        "mesh.su2:6: zone 2 has another dimension (NDIME=) than the zones before it");
}

}  // namespace trismooth::su2_test

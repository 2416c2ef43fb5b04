// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/text_format.h"

namespace trismooth::off_test {

const TextFormat off(".off");

const std::string house = "OFF\n5 3 0\n0 0 0\n1 0 0.5\n1 1 0\n0 1 0\n0.5 1.75 0\n3 0 1 2\n4 0 1 2 3\n5 0 1 2 4 3\n";
const std::vector<double> house_points{0, 0, 0, 1, 0, 0.5, 1, 1, 0, 0, 1, 0, 0.5, 1.75, 0};

void check_house(const MeshDocument& document) {
  CHECK(document.format == FileFormat::off);
  CHECK(document.points == house_points);
  CHECK(document.point_type == trismooth::ScalarType::float64);
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::quad, cell_type::polygon});
  CHECK(document.cells.offsets == std::vector<std::int64_t>{0, 3, 7, 12});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 4, 3});
  CHECK(document.field_arrays.empty());
}

TEST_CASE("OFF: the mesh is the same however the file is laid out") {
  const std::string text = GENERATE_COPY(
      as<std::string>{}, house, house.substr(0, house.size() - 1), house.substr(4), replace_all(house, "OFF\n", "OFF "),
      replace_all(house, "OFF\n", "OFF"), replace_all(house, "5 3 0", "5 3"), replace_all(house, "5 3 0", "5 3 77"),
      replace_all(house, "5 3 0", "5\n3\n0"), replace_all(house, "5 3 0", "+5 3 0"),
      replace_all(house, "\n", " # comment 1 2 3\n\n#\n \t"), "# first\n\n  # second\n" + house, "\xEF\xBB\xBF" + house,
      replace_all(house, " ", "\t  "), replace_all(house, "0.5", "+5.0E-01"),
      replace_all(house, "1 1 0\n", "1\n1\n0\n"), replace_all(house, "4 0 1 2 3", "4 0 1\n2 3"), house + "\n\n# end",
      house + " \t");
  const std::string line_end = GENERATE("\n", "\r\n", "\r");
  const std::string file = replace_all(text, "\n", line_end);
  CAPTURE(file);
  const MeshDocument document = off.read(file);
  check_house(document);
  CHECK(document.notes.empty());
  CHECK(document.point_arrays.empty());
  CHECK(document.cell_arrays.empty());
  CHECK(off.written(document) == file);
}

TEST_CASE("OFF: the keyword says which numbers follow the coordinates") {
  const bool texture = GENERATE(false, true);
  const bool normals = GENERATE(false, true);
  const std::size_t colours = GENERATE(0U, 3U, 4U);
  const bool colours_first = GENERATE(false, true);  // as MeshLab writes it
  const std::string prefix = colours_first ? std::string(normals ? "N" : "") + (colours > 0 ? "C" : "")
                                           : std::string(colours > 0 ? "C" : "") + (normals ? "N" : "");
  const std::string keyword =
      colours_first ? prefix + (texture ? "ST" : "") + "OFF" : (texture ? "ST" : "") + prefix + "OFF";
  CAPTURE(keyword, colours);

  std::vector<double> normal_values;
  std::vector<double> colour_values;
  std::vector<double> texture_values;
  std::string text = keyword + "\n5 3 0\n";
  double next = 0.25;  // every number of the file is another
  const auto append = [&](std::vector<double>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i, next += 1) {
      values.push_back(next);
      text += " " + shortest(next);
    }
  };
  for (std::size_t vertex = 0; vertex < 5; ++vertex) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text += " " + shortest(house_points[3 * vertex + axis]);
    }
    if (colours_first) {
      append(colour_values, colours);
    }
    append(normal_values, normals ? 3 : 0);
    if (!colours_first) {
      append(colour_values, colours);
    }
    append(texture_values, texture ? 2 : 0);
    text += " # comment\n";
  }
  text += house.substr(house.find("3 0 1 2"));

  const MeshDocument document = off.read(text);
  check_house(document);
  CHECK(values_of<double>(document.point_arrays, "normals") == normal_values);
  CHECK(values_of<double>(document.point_arrays, "colours") == colour_values);
  CHECK(values_of<double>(document.point_arrays, "texture_coordinates") == texture_values);
  for (const DataArray& array : document.point_arrays) {
    CHECK(array.rows() == 5);
  }
  CHECK(document.notes.empty());
  CHECK(off.written(document) == text);
}

TEST_CASE("OFF: face colours of one kind are a cell array, others stay in the file with a note") {
  const auto with_colours = [](const std::string& first, const std::string& second) {
    return "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " + first + "\n3 2 1 0 " + second + "\n";
  };
  CHECK(values_of<double>(off.read(with_colours("7", "8")).cell_arrays, "colours") == std::vector<double>{7, 8});
  CHECK(values_of<double>(off.read(with_colours("1 2 3", "4 5 6")).cell_arrays, "colours") ==
        std::vector<double>{1, 2, 3, 4, 5, 6});
  const MeshDocument rgba = off.read(with_colours("0.5 .25 1. 1", "0 0 0 1 # c"));
  CHECK(values_of<double>(rgba.cell_arrays, "colours") == std::vector<double>{0.5, 0.25, 1, 1, 0, 0, 0, 1});
  CHECK(rgba.notes.empty());
  for (const std::string second : {"", "1", "1 2 3 4"}) {
    const std::string text = with_colours("1 2 3", second);
    const MeshDocument mixed = off.read(text);
    CHECK(mixed.cells.size() == 2);
    CHECK(mixed.cell_arrays.empty());
    CHECK(mixed.notes.size() == 1);
    CHECK(off.written(mixed) == text);
  }
  CHECK(off.failure_of(with_colours("1 2", "")) ==
        "mesh.off:6: face 1 of 2: expected 0, 1, 3 or 4 colour numbers after the vertices, got 2");
  CHECK_FALSE(off.failure_of(with_colours("", "1 2 3 4 5")).empty());
  CHECK_FALSE(off.failure_of(with_colours("", "red")).empty());
}

TEST_CASE("OFF: vertex colours of three and four numbers may be mixed, with a note") {
  const MeshDocument document = off.read("COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 1 2 3 4\n0 1 0 1 2 3\n3 0 1 2\n");
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  CHECK(document.point_arrays.empty());
  CHECK(document.notes.size() == 1);
}

TEST_CASE("OFF: a mesh without faces or without anything is a mesh") {
  CHECK(off.read("OFF\n0 0 0\n").point_count() == 0);
  CHECK(off.read("0 0").cells.size() == 0);
  CHECK(off.read("OFF 1 0 0\n0 0 0").point_count() == 1);
}

TEST_CASE("OFF: what breaks the rules is refused with its place") {
  const auto replaced = [](const char* from, const char* to) { return replace_all(house, from, to); };
  CHECK(off.failure_of("") ==
        "mesh.off:1: expected the keyword OFF or the number of vertices, got the end of the file");
  CHECK(off.failure_of("ply\n") ==
        "mesh.off:1: is not an OFF file: expected the keyword OFF or the number of vertices, got 'ply'");
  CHECK(off.failure_of("OFF\n") == "mesh.off:2: expected the number of vertices, got the end of the file");
  CHECK(off.failure_of("OFF\n5\n") == "mesh.off:3: expected the number of faces, got the end of the file");
  CHECK(off.failure_of(replaced("OFF", "4OFF")) == "mesh.off:1: unsupported OFF variant '4OFF'");
  CHECK(off.failure_of(replaced("OFF", "nOFF\n3")) == "mesh.off:1: unsupported OFF variant 'nOFF'");
  CHECK(off.failure_of(replaced("OFF", "STCN4nOFF\n3")) == "mesh.off:1: unsupported OFF variant 'STCN4nOFF'");
  CHECK(off.failure_of(replaced("OFF\n", "OFF BINARY ")) ==
        "mesh.off:1: expected the end of the line after BINARY, got '5'");
  CHECK(off.failure_of(replaced("5 3 0", "-5 3 0")) ==
        "mesh.off:2: expected the number of vertices from 0 to 2147483647, got '-5'");
  CHECK(off.failure_of(replaced("5 3 0", "4294967301 3 0")) ==
        "mesh.off:2: expected the number of vertices from 0 to 2147483647, got '4294967301'");
  CHECK(off.failure_of(replaced("5 3 0", "5 4294967299 0")) ==
        "mesh.off:2: expected the number of faces from 0 to 2147483647, got '4294967299'");
  CHECK(
      off.failure_of(replaced("5 3 0", "2000000000 3 0")).find("declares 2000000000 vertices, but the file has room") !=
      std::string::npos);
  CHECK(off.failure_of(replaced("5 3 0", "5 2000000000 0")).find("declares 2000000000 faces, but the file has room") !=
        std::string::npos);
  CHECK(off.failure_of(replaced("1 1 0", "1 nan 0")) ==
        "mesh.off:5: expected a coordinate (a finite number), got 'nan'");
  CHECK(off.failure_of(replaced("1 1 0", "1 -inf 0")) ==
        "mesh.off:5: expected a coordinate (a finite number), got '-inf'");
  CHECK(off.failure_of(replaced("1 1 0", "1 1e999 0")) ==
        "mesh.off:5: expected a coordinate (a finite number), got '1e999'");
  CHECK(off.failure_of(replaced("1 1 0", "1 abc 0")) ==
        "mesh.off:5: expected a coordinate (a finite number), got 'abc'");
  CHECK(off.failure_of(replaced("1 1 0", "1 1 0 9")) ==
        "mesh.off:5: vertex 3 of 5: OFF has 0, 3 or 4 numbers after the "
        "coordinates, got 1");
  CHECK(off.failure_of(replaced("1 1 0", "1 1 0 9 9 9")) ==
        "mesh.off:5: vertex 3 of 5: has a colour, but not the vertices before it");
  CHECK(off.failure_of(replaced("0 0 0", "0 0 0 1 1 1 1")) ==
        "mesh.off:4: vertex 2 of 5: has no colour, but the vertices before it");
  CHECK(off.failure_of(replaced("OFF", "NOFF") + "# " + std::string(100, 'x'))
            .find("vertex 1 of 5: NOFF has 3, 6 or 7 numbers after the coordinates, got none") != std::string::npos);
  CHECK(off.failure_of(replaced("4 0 1 2 3", "4 0 1 2 5")) ==
        "mesh.off:9: face 2 of 3: expected a vertex index, got '5'; the file has 5 vertices, counted from 0");
  CHECK(off.failure_of(replaced("4 0 1 2 3", "4 0 1 2 -1")).find("mesh.off:9: face 2 of 3: ") == 0);
  CHECK(off.failure_of(replaced("4 0 1 2 3", "4 0 1 2 4294967297")).find("mesh.off:9: face 2 of 3: ") == 0);
  CHECK(off.failure_of(replaced("4 0 1 2 3", "4 0 1 2 1.0")).find("mesh.off:9: face 2 of 3: ") == 0);
  for (const std::string degree : {"2", "1", "0", "-3", "x", "18446744073709551619"}) {
    CHECK(off.failure_of(replaced("4 0 1 2 3", (degree + " 0 1").c_str())) ==
          "mesh.off:9: face 2 of 3: expected its number of vertices, 3 or more, got '" + degree + "'");
  }
  CHECK(off.failure_of(replaced("4 0 1 2 3", "1000000000 0 1 2 3")).find("face 2 of 3: declares 1000000000 vertices") !=
        std::string::npos);
  CHECK(off.failure_of(house.substr(0, house.find("5 0 1"))) == "mesh.off:9: expected 3 faces, got 2");
  CHECK(off.failure_of("OFF 3 0 0\n0.000 0.000 0.000\n1.000 0.000 0.000\n") ==
        "mesh.off:3: expected 3 vertices, got 2");
  CHECK(off.failure_of(replaced("0.5 1.75 0\n3 0 1 2", "")).find("mesh.off:") == 0);
}

TEST_CASE("OFF: the keyword may be in lower case, and names the same fields") {
  for (const std::string keyword : {"off", "Off", "oFF"}) {
    CAPTURE(keyword);
    const std::string text = replace_all(house, "OFF", keyword.c_str());
    const MeshDocument document = off.read(text);
    check_house(document);
    CHECK(off.written(document) == text);
  }
  const std::string rows = "\n1 0 0\n0 0 0  0 0 1  10 20 30  0.5 0.25\n";
  const MeshDocument upper = off.read("STCNOFF" + rows);
  const MeshDocument lower = off.read("stcnoff" + rows);
  REQUIRE(lower.point_arrays.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(lower.point_arrays[i].name == upper.point_arrays[i].name);
    CHECK(std::ranges::equal(lower.point_arrays[i].bytes, upper.point_arrays[i].bytes));
  }
  CHECK(off.failure_of("4off" + rows) == "mesh.off:1: unsupported OFF variant '4off'");
  CHECK(off.failure_of("offset" + rows).find("is not an OFF file") != std::string::npos);
}

TEST_CASE("OFF: colours need not be declared, and declared ones may be of the faces alone") {
  const std::string rows = "3 1 0\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2\n";
  const MeshDocument undeclared = off.read("OFF\n" + rows);
  REQUIRE(undeclared.point_arrays.size() == 1);
  CHECK(undeclared.point_arrays[0].name == "colours");
  CHECK(std::ranges::equal(undeclared.point_arrays[0].as<double>(), std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  REQUIRE(undeclared.notes.size() == 1);
  CHECK(undeclared.notes[0].find("OFF declares no colours") != std::string::npos);
  CHECK(off.written(undeclared) == "OFF\n" + rows);

  // OpenMesh writes this where only the faces have colours.
  const std::string of_faces = "COFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7 8 9\n";
  const MeshDocument document = off.read(of_faces);
  CHECK(document.point_arrays.empty());
  CHECK(find_array(document.cell_arrays, "colours") != nullptr);
  CHECK(document.notes.empty());
  CHECK(off.written(document) == of_faces);
}

TEST_CASE("OFF: more numbers than the counts declare are refused, other text behind the mesh stays") {
  CHECK(off.failure_of(house + "3 0 1 2\n") ==
        "mesh.off:11: expected the end of the file after the declared 5 vertices and 3 faces, got '3'");
  const std::string text = house + "{ appearance } \x1a";
  const MeshDocument document = off.read(text);
  check_house(document);
  CHECK(document.notes.size() == 1);
  CHECK(off.written(document) == text);
}

TEST_CASE("OFF: a mesh from elsewhere is written with its exact coordinates and all its faces") {
  MeshDocument document;
  document.format = FileFormat::vtu;
  document.points = {0.1, 1.0 / 3, -0.0, 1e300, 5e-324, 4e7 + 0.25, 0, 1, 2, 3, 4, 5};
  const auto append = [&](std::uint8_t type, const std::vector<std::int32_t>& vertices) {
    document.cells.append(type, vertices);
  };
  append(cell_type::vertex, {0});
  append(cell_type::triangle, {0, 1, 2});
  append(cell_type::line, {0, 1});
  append(cell_type::quad, {3, 2, 1, 0});
  append(cell_type::triangle_strip, {0, 1, 2, 3});
  append(cell_type::line, {1, 2});
  append(cell_type::polygon, {0, 1, 2, 3, 1});
  append(42, {0});
  document.point_arrays.push_back(make_data_array("colours", 1, std::vector<float>{1, 2, 3, 4}));
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<int>(8)));
  document.cell_arrays.push_back(make_data_array("", 1, std::vector<int>(8)));
  document.field_arrays.push_back(make_data_array("TIME", 1, std::vector<double>{1}));

  const std::string text = off.written(document);
  CHECK(text.find("OFF\n4 5 0\n0.1 0.3333333333333333 -0\n1e+300 5e-324 40000000.25\n") == 0);
  CHECK(text.substr(text.find("3 4 5\n") + 6) == "3 0 1 2\n4 3 2 1 0\n3 0 1 2\n3 2 1 3\n5 0 1 2 3 1\n");
  const MeshDocument back = off.read(text);
  CHECK(back.points == document.points);
  CHECK(back.cells.size() == 5);

  CHECK(trismooth::what_is_lost(document, FileFormat::off) ==
        std::vector<std::string>{
            "OFF holds no triangle strips: 1 is written as 2 triangles",
            "OFF holds faces only: 1 cell of type vertex, 2 cells of type line, 1 cell of type 42 (by VTK's numbers) "
            "are not written",
            "OFF holds no point arrays: colours is not written",
            "OFF holds no cell arrays: region, (no name) are not written",
            "OFF holds no field arrays: TIME is not written"});
  MeshDocument plain = back;
  plain.original = nullptr;
  CHECK(trismooth::what_is_lost(plain, FileFormat::off).empty());
}

}  // namespace trismooth::off_test

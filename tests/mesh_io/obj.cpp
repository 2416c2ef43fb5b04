// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/scratch_folder.h"
#include "support/text_format.h"

namespace trismooth::obj_test {

const TextFormat obj(".obj");

const std::string house =
    "v 0 0 0\nv 1 0 0.5\nv 1 1 0\nv 0 1 0\nv 0.5 1.75 0\nf 1 2 3\nf 1 2 3 4\nf 1 2 3 5 4\nl 1 2\nl 1 2 3\np 5\np 1 2\n";
const std::vector<double> house_points{0, 0, 0, 1, 0, 0.5, 1, 1, 0, 0, 1, 0, 0.5, 1.75, 0};

void check_house(const MeshDocument& document) {
  CHECK(document.format == FileFormat::obj);
  CHECK(document.points == house_points);
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::quad, cell_type::polygon,
                                                          cell_type::line, cell_type::poly_line, cell_type::vertex,
                                                          cell_type::poly_vertex});
  CHECK(document.cells.offsets == std::vector<std::int64_t>{0, 3, 7, 12, 14, 17, 18, 20});
  CHECK(document.cells.connectivity ==
        std::vector<std::int32_t>{0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 4, 3, 0, 1, 0, 1, 2, 4, 0, 1});
}

std::vector<std::int32_t> numbers_of(const MeshDocument& document, const std::string& name) {
  const DataArray* const array = find_array(document.cell_arrays, name);
  if (array == nullptr) {
    return {};
  }
  CHECK(array->type == trismooth::ScalarType::int32);
  CHECK(array->rows() == document.cells.size());
  const auto values = array->as<std::int32_t>();
  return {values.begin(), values.end()};
}

TEST_CASE("OBJ: the mesh is the same however the file is laid out") {
  const std::string text =
      GENERATE_COPY(as<std::string>{}, house, house.substr(0, house.size() - 1), replace_all(house, " ", "\t "),
                    replace_all(house, "\n", " # 1 2 3\n\n#\n  "), "# head\n" + house, "# C:\\folder\\\n" + house,
                    "\xEF\xBB\xBF" + house, replace_all(house, " ", " \\\n"), replace_all(house, " ", "\\\n "),
                    replace_all(house, "0.5", "+5.0E-01"), replace_all(house, "f ", "fo "), house + "\n\n");
  const std::string line_end = GENERATE("\n", "\r\n", "\r");
  const std::string file = replace_all(text, "\n", line_end);
  CAPTURE(file);
  const MeshDocument document = obj.read(file);
  check_house(document);
  CHECK(document.notes.empty());
  CHECK(document.point_arrays.empty());
  CHECK(document.cell_arrays.empty());
  CHECK(obj.written(document) == file);
}

TEST_CASE("OBJ: every form of reference means the same vertex") {
  const std::string tail = GENERATE("", "/7", "//-8", "/7/8", "/", "//", "/7/");
  const std::string points = house.substr(0, house.find("f 1"));
  const auto face = [&](int a, int b, int c) {
    return "f " + std::to_string(a) + tail + " " + std::to_string(b) + tail + " " + std::to_string(c) + tail + "\n";
  };
  CAPTURE(tail);
  const MeshDocument document = obj.read(points + face(1, 3, 5) + face(-5, -3, -1) + "v 9 9 9\n" + face(-6, -4, -2));
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 2, 4, 0, 2, 4, 0, 2, 4});
}

TEST_CASE("OBJ: a reference may run ahead of the vertices, but not beyond the last") {
  CHECK(obj.read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").cells.connectivity == std::vector<std::int32_t>{0, 1, 2});
  CHECK(obj.failure_of("v 0 0 0\nf 1 2 3\nf 1 4 5\nf 1 2 5\nv 1 0 0\nv 0 1 0\n") ==
        "mesh.obj:3: vertex index 5 is out of range: the file has 3 vertices");
}

TEST_CASE("OBJ: weights and colours of vertices stay in the file with a note") {
  for (const std::string extra : {" 1", " 0.5 0.25 1", " 1 0.5 0.25 1"}) {
    const std::string text = replace_all(house, "v 1 1 0", "v 1 1 0" + extra);
    const MeshDocument document = obj.read(text);
    check_house(document);
    CHECK(document.notes == std::vector<std::string>{"Kept in OBJ output only: vertex colours or weights."});
    CHECK(obj.written(document) == text);
  }
}

TEST_CASE("OBJ: materials and groups number the cells") {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl Material #25\nf 1 2 3\ng a  b\nl 1 2\nusemtl other # 1\nf 1 2 3\n"
      "usemtl\tMaterial  \\\n #25 \nf 1 2 3\ng\np 1\ng a b\np 1\n";
  const MeshDocument document = obj.read(text);
  CHECK(numbers_of(document, "material") == std::vector<std::int32_t>{-1, 0, 0, 1, 0, 0, 0});
  CHECK(numbers_of(document, "group") == std::vector<std::int32_t>{-1, -1, 0, 0, 0, 1, 0});
  const auto names = [&document](std::size_t array) { return document.cell_arrays.at(array).description->value_names; };
  CHECK(names(0) == std::vector<ValueName>{
                        {0, 0, "Material #25"}, {0, 1, "Material #25"}, {0, 2, "Material #25"}, {1, 2, "other # 1"}});
  CHECK(names(1) == std::vector<ValueName>{{0, 0, "a b"}, {0, 1, "a b"}, {0, 2, "a b"}});
  CHECK(obj.written(document) == text);
  CHECK(numbers_of(obj.read(house + "usemtl late\n"), "material") == std::vector<std::int32_t>(7, -1));
}

TEST_CASE("OBJ: other statements are kept and named") {
  const std::string text =
      "mtllib a b.mtl\no thing # 1\nvt 0 0\nvn nonsense\ns off\n" + house + "vp 1\ncstype bezier \\\n v 7 7 7\nend\n";
  const MeshDocument document = obj.read(text);
  check_house(document);
  CHECK(document.notes == std::vector<std::string>{"Kept in OBJ output only: cstype, end, mtllib, o, s, vn, vp, vt."});
  CHECK(obj.written(document) == text);
}

TEST_CASE("OBJ: what breaks the rules is refused with its place") {
  const auto replaced = [](const char* from, const char* to) { return replace_all(house, from, to); };
  CHECK(obj.failure_of(replaced("v 1 1 0", "v 1 nan 0")) ==
        "mesh.obj:3: expected a number of a vertex (a finite number), got 'nan'");
  CHECK(obj.failure_of(replaced("v 1 1 0", "v 1 1e999 0")).find("mesh.obj:3: ") == 0);
  CHECK(obj.failure_of(replaced("v 1 1 0", "v 1 abc 0")).find("mesh.obj:3: ") == 0);
  CHECK(obj.failure_of(replaced("v 1 1 0", "v 1 1")) ==
        "mesh.obj:3: vertex 3: expected 3 coordinates (and a weight, a colour or both), got 2 numbers");
  CHECK(obj.failure_of(replaced("v 1 1 0", "v")) ==
        "mesh.obj:3: vertex 3: expected 3 coordinates (and a weight, a colour or both), got 0 numbers");
  CHECK(obj.failure_of(replaced("v 1 1 0", "v 1")).find("vertex 3: ") != std::string::npos);
  CHECK(obj.failure_of(replaced("v 1 1 0", "v 1 1 0 1 1")).find("mesh.obj:3: vertex 3: ") == 0);
  CHECK(obj.failure_of(replaced("v 1 1 0", "v 1 1 0 1 1 1 1 1")).find("mesh.obj:3: vertex 3: ") == 0);
  CHECK(obj.failure_of(replaced("f 1 2 3\n", "f 1 2\n")) == "mesh.obj:6: expected 3 or more vertices of a face, got 2");
  CHECK(obj.failure_of(replaced("f 1 2 3\n", "f\n")) == "mesh.obj:6: expected 3 or more vertices of a face, got 0");
  CHECK(obj.failure_of(replaced("l 1 2\n", "l 1\n")) == "mesh.obj:9: expected 2 or more vertices of a line, got 1");
  CHECK(obj.failure_of(replaced("p 5\n", "p\n")) == "mesh.obj:11: expected 1 or more vertices of a point, got 0");
  for (const char* index : {"0", "-6", "2147483648", "4294967297", "18446744073709551617", "x", "1.0", "/1", ""}) {
    CAPTURE(index);
    const std::string message = obj.failure_of(replaced("f 1 2 3\n", ("f 1 2 " + std::string(index) + "/1\n").c_str()));
    CHECK(message == "mesh.obj:6: expected a vertex index, got '" + std::string(index) +
                         "/1'; 5 vertices stand before this line, counted from 1");
  }
  for (const char* vertex : {"3/x", "3/1/x", "3/1/1/1", "3///", "3/1.5", "3/4294967296000000000000"}) {
    CAPTURE(vertex);
    CHECK(obj.failure_of(replaced("f 1 2 3\n", ("f 1 2 " + std::string(vertex) + "\n").c_str())) ==
          "mesh.obj:6: expected a vertex as v, v/vt, v//vn or v/vt/vn with whole numbers, got '" + std::string(vertex) +
              "'");
  }
  CHECK(obj.failure_of(replaced("f 1 2 3\n", "f 1 2 6\n")) ==
        "mesh.obj:6: vertex index 6 is out of range: the file has 5 vertices");
  CHECK(obj.failure_of(replaced("f 1 2 3\n", "f 1 2\n3\n")).find("mesh.obj:6: ") == 0);
  CHECK(obj.failure_of(replaced("v 1 1 0\n", "v 1 1 0\n 0 1 0\n")) ==
        "mesh.obj:4: expected a statement of OBJ, got '0'");
  CHECK(obj.failure_of(std::string("\x7f"
                                   "ELF\x02\0\0",
                                   7)) == "mesh.obj:1: expected a statement of OBJ, got '\\x7fELF\\x02\\x00\\x00'");
}

TEST_CASE("OBJ: writing back changes the coordinates that changed and no other byte") {
  std::mt19937 random(2);
  const auto pick = [&](const std::vector<std::string>& choices) { return choices[random() % choices.size()]; };
  const std::vector<const char*> formats{"%.17g", "%.3f", "%+.10e", "%.0f.", "%.2E", "%g"};
  for (int run = 0; run < 50; ++run) {
    const std::size_t vertices = 3 + random() % 20;
    std::string text = pick({"", "# head 1 2 3\n", "\xEF\xBB\xBF"});
    std::vector<std::string> tokens;
    std::vector<double> values;
    for (std::size_t i = 0; i < 3 * vertices; ++i) {
      std::array<char, 400> buffer{};
      std::snprintf(buffer.data(), buffer.size(), formats[random() % formats.size()],
                    std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 80) - 60));
      tokens.emplace_back(buffer.data());
      values.push_back(std::strtod(buffer.data(), nullptr));
      text += i % 3 == 0 ? pick({"v ", " v\t", "vn 1 2 3\nv ", "f 1 2 3\nv "}) : pick({" ", "\t ", "\\\n", " \\\r\n"});
      text += "@";
      text += i % 3 == 2 ? pick({"\n", "\r\n", " \r", "#1 2\n", " 1\n", " 1 2 3 # c\n\n"}) : "";
    }
    text += "f 1 2 3\n";

    MeshDocument document = obj.read(fill(text, tokens));
    REQUIRE(document.points == values);
    REQUIRE(obj.written(document) == fill(text, tokens));
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (random() % 3 == 0) {
        document.points[i] = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 200) - 100) + 0.1;
        tokens[i] = document.points[i] == values[i] ? tokens[i] : shortest(document.points[i]);
      }
    }
    const std::string output = obj.written(document);
    REQUIRE(output == fill(text, tokens));
    REQUIRE(obj.read(output).points == document.points);
  }
}

TEST_CASE("OBJ: a mesh from elsewhere is written with its exact coordinates and all its cells") {
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
  append(cell_type::poly_line, {1, 2, 3});
  append(cell_type::polygon, {0, 1, 2, 3, 1});
  append(cell_type::poly_vertex, {0, 3});
  document.cell_arrays.push_back(make_data_array("material", 1, std::vector<int>(8)));

  const std::string text = obj.written(document);
  CHECK(text ==
        "v 0.1 0.3333333333333333 -0\nv 1e+300 5e-324 40000000.25\nv 0 1 2\nv 3 4 5\np 1\nf 1 2 3\nl 1 2\nf 4 3 2 1\n"
        "f 1 2 3\nf 3 2 4\nl 2 3 4\nf 1 2 3 4 2\np 1 4\n");
  CHECK(obj.read(text).points == document.points);
  CHECK(trismooth::what_is_lost(document, FileFormat::obj) ==
        std::vector<std::string>{"OBJ holds no triangle strips: 1 is written as 2 triangles",
                                 "OBJ holds no cell arrays: material is not written"});
}

TEST_CASE("OBJ: a mesh of nothing is written as a file that can be read") {
  CHECK(obj.written({}) == "# no vertices\n");
  CHECK(obj.read(obj.written({})).points.empty());
}

}  // namespace trismooth::obj_test

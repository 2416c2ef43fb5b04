// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/stl/point_welder.h"

#include "byte_files.h"
#include "catch.h"

namespace trismooth::stl_test {

using namespace byte_files;

/// Four triangles around `centre`: a file in which a user moves one vertex.
std::string fan_text(const std::string& centre, const std::string& line_end = "\n") {
  const std::vector<std::string> corners{"0 0 0", "1.0 0 -0", "1e0 +1 0", "-0.0 1 0", "0 0 0"};
  std::string text;
  const auto add_line = [&](const std::string& line) { text.append(line).append(line_end); };
  add_line("solid fan  of four");
  for (std::size_t i = 0; i < 4; ++i) {
    add_line(" FACET normal 0 0 1");
    add_line("  outer Loop");
    add_line("   vertex " + corners[i]);
    add_line("\tvertex " + corners[i + 1]);
    add_line("vertex  " + centre);
    add_line("  endloop");
    add_line(" EndFacet");
  }
  add_line("endsolid fan of four");
  return text;
}

std::string binary_file(const std::vector<std::array<float, 9>>& facets, const std::vector<std::uint16_t>& attributes,
                        const std::string& title = "binary") {
  std::string bytes = title;
  bytes.resize(80);
  bytes += number_bytes(static_cast<std::uint32_t>(facets.size()));
  for (std::size_t facet = 0; facet < facets.size(); ++facet) {
    for (const float component : {0.F, 0.F, 7.F}) {
      bytes += number_bytes(component);
    }
    for (const float coordinate : facets[facet]) {
      bytes += number_bytes(coordinate);
    }
    bytes += number_bytes(attributes[facet]);
  }
  return bytes;
}

std::string fan_binary(float x, float y, std::uint16_t attribute = 0) {
  return binary_file({{0, 0, 0, 1, 0, 0, x, y, 0},
                      {1, 0, 0, 1, 1, 0, x, y, 0},
                      {1, 1, 0, 0, 1, 0, x, y, 0},
                      {0, 1, 0, 0, 0, -0.F, x, y, 0}},
                     {0, 0, attribute, 0});
}

const std::vector<std::int32_t> fan_corners{0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2};

/// A grid of squares, each cut in two, its inner points shaken.
MeshDocument grid(int cells, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.2, 0.2);
  MeshDocument document;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && y > 0 && x < cells && y < cells;
      document.points.insert(document.points.end(),
                             {x + (inner ? shake(random) : 0), y + (inner ? shake(random) : 0), 0.0});
    }
  }
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const std::int32_t a = y * (cells + 1) + x;
      const std::int32_t d = a + cells + 1;
      document.cells.append(cell_type::triangle, std::array{a, a + 1, d + 1});
      document.cells.append(cell_type::triangle, std::array{a, d + 1, d});
    }
  }
  return document;
}

TEST_CASE("STL: corners at one place are one point, in text and in binary") {
  const std::string bytes = GENERATE(fan_text("0.5 0.25 0"), fan_text("0.5 0.25 0", "\r\n"), fan_binary(0.5F, 0.25F));
  const MeshDocument document = stl_codec.read("fan.stl", bytes);
  CHECK(is_valid(document));
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 0.5, 0.25, 0, 1, 1, 0, 0, 1, 0});
  CHECK(document.cells.connectivity == fan_corners);
  CHECK(document.cells.types == std::vector<std::uint8_t>(4, cell_type::triangle));
  CHECK(document.cell_arrays.empty());
  CHECK(written_back(document) == bytes);
}

TEST_CASE("STL: a moved point changes at all its corners, and no other byte does") {
  SECTION("text") {
    MeshDocument document = stl_codec.read("fan.stl", fan_text("0.5 .25 0"));
    CHECK(document.point_type == ScalarType::float64);
    document.points[6] = 0.1;
    CHECK(written_back(document) == fan_text("0.1 .25 0"));
    document.points[7] = 1.0 / 3;
    CHECK(written_back(document) == fan_text("0.1 0.3333333333333333 0"));
  }
  SECTION("binary") {
    MeshDocument document = stl_codec.read("fan.stl", fan_binary(0.5F, 0.25F, 9));
    CHECK(document.point_type == ScalarType::float32);
    document.points[6] = static_cast<double>(0.1F);
    CHECK(written_back(document) == fan_binary(0.1F, 0.25F, 9));
  }
}

TEST_CASE("STL: binary is told from text by the size, whatever the first word") {
  const std::array<float, 9> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes = binary_file({triangle}, {0}, "solid but binary");
  CHECK(stl_codec.read("solid.stl", bytes).cells.size() == 1);
  CHECK(stl_codec.read("solid.stl", bytes + "x").cells.size() == 1);
  CHECK(contains(refusal(stl_codec, bytes.substr(0, 120)), "declares 1 facets, but"));
}

TEST_CASE("STL: the attribute words of binary facets are an array where any is not 0") {
  const MeshDocument document = stl_codec.read("fan.stl", fan_binary(0.5F, 0.25F, 65535));
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].name == "attribute");
  const auto words = document.cell_arrays[0].as<std::uint16_t>();
  CHECK(std::vector(words.begin(), words.end()) == std::vector<std::uint16_t>{0, 0, 65535, 0});
}

TEST_CASE("STL: several solids are numbered in an array") {
  const std::string facet =
      "facet normal nan -nan 1.#IND outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
  const std::string bytes =
      "\n solid one\n" + facet + "endsolid one\nSOLID\nendsolid\nsolid three\n" + facet + facet + "endsolid";
  const MeshDocument document = stl_codec.read("solids.stl", bytes);
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].name == "solid");
  const auto solids = document.cell_arrays[0].as<std::int32_t>();
  CHECK(std::vector(solids.begin(), solids.end()) == std::vector<std::int32_t>{0, 2, 2});
  CHECK(document.notes.size() == 1);
  CHECK(written_back(document) == bytes);
}

TEST_CASE("STL: no facets are an empty document") {
  // The shortest text fits in a string's own memory, where a view of it does not survive a move.
  const std::string bytes =
      GENERATE(std::string("solid\nendsolid"), std::string("solid a name\nendsolid a name\n"), binary_file({}, {}));
  const MeshDocument document = stl_codec.read("empty.stl", bytes);
  CHECK(document.point_count() == 0);
  CHECK(document.cells.size() == 0);
  CHECK(written_back(document) == bytes);
}

TEST_CASE("STL: what is no STL is refused with its place") {
  struct Case {
    std::string bytes;
    std::string message;
  };
  const std::string begin = "solid s\nfacet normal 0 0 1\nouter loop\n";
  const std::string corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  const std::string end = "endloop\nendfacet\n";
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::string huge = binary_file({{}}, {0});
  huge.replace(80, 4, "\xff\xff\xff\xff");
  const std::vector<Case> cases{
      {"", "too short"},
      {"OFF\n", "does not begin with 'solid'"},
      {"solid s\n", "facet or endsolid, got the end of the file"},
      {begin + corners + end + "facet\n", ":10: expected normal, got the end of the file"},
      {begin + corners + end + "1 2 3\n", ":9: expected facet or endsolid, got '1'"},
      {begin + corners + end + "vertex 1 2 3\n", ":9: expected facet or endsolid, got 'vertex'"},
      {begin + "vertex 0 0 0\nvortex 1 0 0\nvertex 0 1 0\n" + end, ":7: expected vertex, got 'endloop'"},
      {begin + corners + "endloop colour\nendfacet\n", ":7: expected endfacet, got 'colour'"},
      {begin + corners + "endloop\n", "expected endfacet, got the end of the file"},
      {begin + "vertex 0 0 0\nvertex 1 0 0\nendloop\n", ":6: expected vertex, got 'endloop'"},
      {begin + corners + "vertex 1 1 0\n" + end, ":7: expected endloop, got 'vertex'"},
      {begin + "vertex 0 nan 0\n", ":4: expected a coordinate (a finite number), got 'nan'"},
      {begin + "vertex 0 0 1e999\n", ":4: expected a coordinate"},
      {begin + "vertex 0 0\nvertex 1 0 0\n", ":5: expected a coordinate (a finite number), got 'vertex'"},
      {"solid s\nfacet normal 0 0\nouter loop\n", ":3: expected outer, got 'loop'"},
      {begin + corners + end + "endsolid s\nfacet normal 0 0 1\n", ":10: expected solid, got 'facet'"},
      {binary_file({{0, 0, 0, 1, 0, nan, 0, 1, 0}}, {0}), "byte 116: facet 0"},
      {binary_file({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, -infinity, 0, 1, 0, 0, 0, 1, 0}}, {0, 0}), "byte 150: facet 1"},
      {huge, "declares 4294967295 facets, but the file has room for 1"},
  };
  for (const Case& refused : cases) {
    CAPTURE(refused.bytes, refused.message);
    const std::string message = refusal(stl_codec, refused.bytes);
    CAPTURE(message);
    CHECK(contains(message, refused.message));
    CHECK(message.starts_with("mesh:"));
    CHECK_FALSE(contains(message, "\n"));
  }
}

TEST_CASE("STL: text without endsolid, with lines of other programs, behind a byte-order mark is read and kept") {
  const MeshDocument plain = stl_codec.read("fan.stl", fan_text("0.25 0.5 0"));
  const auto check = [&](const std::string& text, const std::string& note) {
    CAPTURE(text);
    MeshDocument document = stl_codec.read("fan.stl", text);
    CHECK(document.points == plain.points);
    CHECK(document.cells.connectivity == plain.cells.connectivity);
    REQUIRE(document.notes.size() == (note.empty() ? 0U : 1U));
    CHECK((note.empty() || contains(document.notes.front(), note)));
    CHECK(written_back(document) == text);
    document.points[6] = 0.125;  // the centre
    std::string moved = text;
    for (std::size_t at = moved.find("0.25 0.5"); at != moved.npos; at = moved.find("0.25 0.5")) {
      moved.replace(at, 4, "0.125");
    }
    CHECK(written_back(document) == moved);
  };
  const std::string text = fan_text("0.25 0.5 0");
  REQUIRE(plain.points[6] == 0.25);
  check("\xEF\xBB\xBF" + text, "");
  check(text.substr(0, text.find("endsolid")), "endsolid");
  std::string lines = text;
  lines.insert(lines.find(" FACET"), "color 0.5 0.5 0.5\n");
  lines.insert(lines.find("  endloop"), "  attribute-7 vertex 1 2 3\n");
  check(lines + "made by hand\n", "'attribute-7', 'color', 'made'");
}

TEST_CASE("STL: solids may follow each other without endsolid") {
  const std::string text = fan_text("0.25 0.5 0");
  const std::string open = text.substr(0, text.find("endsolid"));
  const MeshDocument document = stl_codec.read("fan.stl", open + open + text);
  CHECK(document.cells.size() == 12U);
  REQUIRE(document.cell_arrays.size() == 1U);
  CHECK(std::ranges::count(document.cell_arrays.front().as<std::int32_t>(), 2) == 4);
}

TEST_CASE("STL: bytes behind the last facet are noted and kept, but facets that are not declared are refused") {
  const std::string one = binary_file({{0, 0, 0, 1, 0, 0, 0, 1, 0}}, {7}, "COLOR=rgba");
  for (const std::string& tail :
       {std::string("made by hand\n"), std::string(1, '\0'), std::string(50, '\0'), std::string(120, 'x')}) {
    CAPTURE(tail);
    const MeshDocument document = stl_codec.read("one.stl", one + tail);
    CHECK(document.cells.size() == 1U);
    REQUIRE(document.notes.size() == 1U);
    CHECK(contains(document.notes.front(), "at byte 134"));
    CHECK(written_back(document) == one + tail);
  }
  const std::string two = binary_file({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1, 0}}, {0, 0});
  std::string wrong = two;
  wrong[80] = 1;
  CHECK(contains(refusal(stl_codec, wrong), "byte 80: declares 1 facets, but the file has room for 2"));
  wrong.replace(134, 12, number_bytes(0.F) + number_bytes(0.F) + number_bytes(1.F));
  CHECK(contains(refusal(stl_codec, wrong + "and more"), "byte 80: declares 1 facets"));
  wrong[80] = 0;
  CHECK(contains(refusal(stl_codec, wrong), "byte 80: declares 0 facets"));
}

TEST_CASE("STL: what is written from scratch is read back with exact coordinates") {
  const auto type = GENERATE(ScalarType::float64, ScalarType::float32);
  MeshDocument document = grid(7, 3);
  document.point_type = type;
  if (type == ScalarType::float32) {
    for (double& coordinate : document.points) {
      coordinate = static_cast<double>(static_cast<float>(coordinate));
    }
  }
  const TemporaryPath file(".stl");
  trismooth::write_mesh(file.path(), document);
  const MeshDocument back = trismooth::read_mesh(file.path());
  REQUIRE(back.point_count() == document.point_count());
  REQUIRE(back.cells.size() == document.cells.size());
  for (std::size_t corner = 0; corner < document.cells.connectivity.size(); ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double before = document.points[3 * static_cast<std::size_t>(document.cells.connectivity[corner]) + axis];
      const double after = back.points[3 * static_cast<std::size_t>(back.cells.connectivity[corner]) + axis];
      REQUIRE(before == after);
    }
  }
  CHECK(written_back(back) == file.bytes());
  // Read in the order of its corners, the document now loses nothing.
  CHECK(stl_codec.what_is_lost(back).empty());
}

TEST_CASE("STL: OpenMesh reads what is written") {
  const MeshDocument document = grid(5, 8);
  const TemporaryPath file(".stl");
  trismooth::write_mesh(file.path(), document);
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  REQUIRE(OpenMesh::IO::read_mesh(mesh, file.path().string()));
  CHECK(mesh.n_vertices() == document.point_count());
  CHECK(mesh.n_faces() == document.cells.size());
  // Every point is there, as OpenMesh rounds it.
  std::map<std::pair<float, float>, int> found;
  for (const auto vertex : mesh.vertices()) {
    ++found[{mesh.point(vertex)[0], mesh.point(vertex)[1]}];
  }
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    const std::pair point{static_cast<float>(document.points[3 * v]), static_cast<float>(document.points[3 * v + 1])};
    CHECK(found[point] == 1);
  }
}

TEST_CASE("STL: normals are unit vectors by the right-hand rule, at every scale") {
  const double scale = GENERATE(1.0, 1e-200, 1e300);
  MeshDocument document;
  document.points = {0, 0, 0, 2 * scale, 0, 0, 0, scale, 0, 0, 0, -scale};
  document.cells.append(cell_type::triangle, std::array{0, 1, 2});
  document.cells.append(cell_type::triangle, std::array{0, 2, 1});
  document.cells.append(cell_type::triangle, std::array{0, 1, 3});
  document.cells.append(cell_type::triangle, std::array{0, 1, 1});
  const TemporaryPath file(".stl");
  stl_codec.write(file.path(), document);
  const std::string text = file.bytes();
  std::size_t place = 0;
  for (const std::string normal : {"normal 0 0 1\n", "normal 0 0 -1\n", "normal 0 1 0\n", "normal 0 0 0\n"}) {
    CAPTURE(text, normal);
    place = text.find(normal, place);
    REQUIRE(place != std::string::npos);
    ++place;
  }
}

TEST_CASE("STL: what cannot be kept is named") {
  using trismooth::make_data_array;
  MeshDocument document = grid(2, 1);
  document.points.insert(document.points.end(), {0, 0, 0, 9, 9, 0});
  document.cells.append(cell_type::triangle, std::array{9, 1, 4});
  document.cells.append(cell_type::quad, std::array{0, 1, 4, 3});
  document.cells.append(cell_type::line, std::array{0, 1});
  document.cells.append(cell_type::line, std::array{1, 2});
  document.point_arrays = {make_data_array("fixed", 1, std::vector<std::uint8_t>(11))};
  document.cell_arrays = {make_data_array("region", 1, std::vector<std::int32_t>(12))};
  document.field_arrays = {make_data_array("time", 1, std::vector<double>{1})};
  const std::vector<std::string> lost = trismooth::what_is_lost(document, trismooth::FileFormat::stl);
  CHECK(lost.size() == 8);
  for (const std::string part :
       {"not written are 2 lines", "1 quadrilateral is written as the two", "1 points that no triangle uses",
        "leaves 9 of 10", "numbering", "point array 'fixed'", "cell array 'region'", "field array 'time'"}) {
    CAPTURE(part);
    CHECK(std::ranges::any_of(lost, [&](const std::string& sentence) { return contains(sentence, part); }));
  }
}

TEST_CASE("welding numbers points as an ordered map of coordinates does") {
  std::mt19937 random(5);
  trismooth::PointWelder welder;
  std::map<std::array<double, 3>, std::int32_t> numbers;
  const std::array<double, 6> coordinates{0.0, -0.0, 1.0, -1.0, 1e-300, std::nextafter(1.0, 2.0)};
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 3> point{};
    for (double& coordinate : point) {
      coordinate = coordinates[random() % 6] + static_cast<double>(random() % 10);
    }
    const auto expected = numbers.emplace(point, static_cast<std::int32_t>(numbers.size())).first->second;
    REQUIRE(welder.weld(point) == expected);
  }
  CHECK(welder.size() == numbers.size());
}

}  // namespace trismooth::stl_test

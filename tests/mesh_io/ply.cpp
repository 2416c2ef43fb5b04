// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"
#include "ply_files.h"

namespace trismooth::ply_test {

using namespace byte_files;
using namespace ply_files;

TEST_CASE("PLY: every flavour gives the same mesh") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  CAPTURE(to_text(flavour));
  const MeshDocument document = ply_codec.read("square.ply", square_file(flavour));
  CHECK(is_valid(document));
  CHECK(document.point_type == ScalarType::float64);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.25, 0});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 0, 4});
  CHECK(document.cells.offsets == std::vector<std::int64_t>{0, 3, 6, 10});
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::triangle, cell_type::quad});
  REQUIRE(document.point_arrays.size() == 1);
  CHECK(values<std::uint8_t>(find_array(document.point_arrays, "red")) ==
        std::vector<std::uint8_t>{250, 251, 252, 253, 254});
  REQUIRE(document.cell_arrays.size() == 2);
  CHECK(values<std::int8_t>(find_array(document.cell_arrays, "side")) == std::vector<std::int8_t>{-1, 0, 1});
  CHECK(values<std::uint16_t>(find_array(document.cell_arrays, "region")) ==
        std::vector<std::uint16_t>{65534, 65533, 65532});
  CHECK(document.notes.size() == 2);  // the camera and the list uv
}

TEST_CASE("PLY: a text coordinate of type float is the float32 that its text rounds to") {
  const MeshDocument document = ply_codec.read("f.ply", ascii(three, "0.1 0 0\n16777217 0 0\n0 1 0\n"));
  CHECK(document.point_type == ScalarType::float32);
  CHECK(document.points[0] == static_cast<double>(0.1F));
  CHECK(document.points[3] == 16777216.0);
  // The original texts say more than float32 holds, and stay.
  CHECK(contains(written_back(document), "\n16777217 0 0\n"));
}

TEST_CASE("PLY: elements and properties may come in any order") {
  const MeshDocument document =
      ply_codec.read("o.ply", ascii("element face 1\n" + face +
                                        "element vertex 3\nproperty double z\nproperty double nx\n"
                                        "property double x\nproperty double y\n",
                                    "3 2 1 0\n7 9 1 4\n\n7 nan 2\n5\n7 -inf 3 6\n"));
  CHECK(document.points == std::vector<double>{1, 4, 7, 2, 5, 7, 3, 6, 7});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{2, 1, 0});
  CHECK(std::isnan(values<double>(find_array(document.point_arrays, "nx"))[1]));
}

TEST_CASE("PLY: edges are lines, in the order of the file, and cell arrays have a row for each") {
  const std::string vertices = three;
  const std::string edges = "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n";
  const std::string faces = "element face 1\n" + face + "property int region\n";
  SECTION("after the faces") {
    const auto document =
        ply_codec.read("e.ply", ascii(vertices + faces + edges, three_rows + "3 0 1 2 8\n0 1 5\n1 2 6\n"));
    CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::line, cell_type::line});
    CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 1, 1, 2});
    CHECK(values<std::int32_t>(find_array(document.cell_arrays, "region")) == std::vector<std::int32_t>{8, 0, 0});
    CHECK(values<std::uint8_t>(find_array(document.cell_arrays, "red")) == std::vector<std::uint8_t>{0, 5, 6});
    CHECK(document.notes.size() == 2);
  }
  SECTION("before the faces") {
    const auto document = ply_codec.read("e.ply", ascii(edges + "property int region\n" + vertices + faces,
                                                        "0 1 5 1\n1 2 6 2\n" + three_rows + "3 0 1 2 8\n"));
    CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::line, cell_type::line, cell_type::triangle});
    CHECK(values<std::int32_t>(find_array(document.cell_arrays, "region")) == std::vector<std::int32_t>{1, 2, 8});
  }
  SECTION("out of range") {
    CHECK(
        contains(refusal(ply_codec, ascii(vertices + edges, three_rows + "0 1 5\n1 3 6\n")), "edge 1: vertex index 3"));
  }
}

TEST_CASE("PLY: header lines may end in any way, also before binary rows that begin like a line end") {
  // The first byte of the first coordinate is a line feed.
  const std::string rows =
      number_bytes(std::bit_cast<double>(std::uint64_t{0x3ff000000000000a})) + number_bytes(2.0) + number_bytes(3.0);
  for (const std::string line_end : {"\n", "\r\n", "\r"}) {
    std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty float64 y\n"
        "property double z\nend_header\n";
    for (std::size_t i = 0; (i = header.find('\n', i)) != std::string::npos; i += line_end.size()) {
      header.replace(i, 1, line_end);
    }
    const MeshDocument document = ply_codec.read("l.ply", header + rows);
    CHECK(document.points == std::vector<double>{std::bit_cast<double>(std::uint64_t{0x3ff000000000000a}), 2, 3});
  }
}

TEST_CASE("PLY: coordinates of two types keep theirs, each in its own column") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  Rows rows(flavour);
  rows.add(500000.1, "500000.1").add(0.1F, "0.10").add(7.3, "7.30").end();
  rows.add(500001.2, "500001.2").add(0.2F, "0.20").add(7.3, "7.30").end();
  rows.add(500000.3, "500000.3").add(1.2F, "1.20").add(7.3, "7.30").end();
  const std::string bytes = "ply\nformat " + to_text(flavour) +
                            " 1.0\nelement vertex 3\nproperty double x\nproperty float y\nproperty double z\n"
                            "end_header\n" +
                            rows.bytes();
  MeshDocument document = ply_codec.read("utm.ply", bytes);
  CHECK(document.points ==
        std::vector<double>{500000.1, double(0.1F), 7.3, 500001.2, double(0.2F), 7.3, 500000.3, double(1.2F), 7.3});
  CHECK(document.point_type == ScalarType::float64);  // what another format needs to hold them
  CHECK(document.moved_point_type() == ScalarType::float32);
  CHECK(written_back(document) == bytes);
  // As a smoother moves it: to numbers that both columns hold.
  document.points[3] = 500000.5;
  document.points[4] = 0.5;
  Rows moved(flavour);
  moved.add(500000.1, "500000.1").add(0.1F, "0.10").add(7.3, "7.30").end();
  moved.add(500000.5, "500000.5").add(0.5F, "0.5").add(7.3, "7.30").end();
  moved.add(500000.3, "500000.3").add(1.2F, "1.20").add(7.3, "7.30").end();
  CHECK(written_back(document) == bytes.substr(0, bytes.size() - rows.bytes().size()) + moved.bytes());
}

TEST_CASE("PLY: 64-bit integers are read exactly, as indices and as values") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  constexpr std::uint64_t highest = std::numeric_limits<std::uint64_t>::max();
  Rows rows(flavour);
  for (const float x : {0.F, 1.F, 0.F}) {
    rows.add(x).add(x == 0 ? 0.F : 1.F).add(0.F).add((std::int64_t{1} << 53) + 1).end();
  }
  rows.add(std::uint64_t{3}).add(std::int64_t{0}).add(std::int64_t{1}).add(std::int64_t{2}).add(highest).add(lowest);
  rows.end();
  const std::string bytes = "ply\nformat " + to_text(flavour) + " 1.0\nelement vertex 3\n" + xyz +
                            "property int64 id\nelement face 1\nproperty list uint64 int64 vertex_indices\n"
                            "property uint64 high\nproperty int64 low\nend_header\n" +
                            rows.bytes();
  const MeshDocument document = ply_codec.read("wide.ply", bytes);
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2});
  const DataArray* const id = find_array(document.point_arrays, "id");
  REQUIRE((id != nullptr && id->type == ScalarType::int64));
  CHECK(id->as<std::int64_t>()[1] == (std::int64_t{1} << 53) + 1);
  CHECK(find_array(document.cell_arrays, "high")->as<std::uint64_t>()[0] == highest);
  CHECK(find_array(document.cell_arrays, "low")->as<std::int64_t>()[0] == lowest);
  CHECK(written_back(document) == bytes);
}

TEST_CASE("PLY: triangle strips, as Stanford's files list them, are cells") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  const bool is_unsigned = GENERATE(false, true);
  if (is_unsigned && flavour == Flavour::ascii) {
    return;  // -1 is no unsigned number in text
  }
  Rows rows(flavour);
  for (const std::array<float, 2> point : {std::array{0.F, 0.F}, {0.F, 1.F}, {1.F, 0.F}, {1.F, 1.F}, {2.F, 0.F}}) {
    rows.add(point[0]).add(point[1]).add(0.F).end();
  }
  rows.add(9).add(0).add(1).add(2).add(3).add(-1).add(4).add(2).add(3).add(-1).add(0.5F).end();
  const std::string bytes = "ply\nformat " + to_text(flavour) + " 1.0\nelement vertex 5\n" + xyz +
                            "element tristrips 1\nproperty list int " + (is_unsigned ? "uint" : "int") +
                            " vertex_indices\nproperty float weight\nend_header\n" + rows.bytes();
  const MeshDocument document = ply_codec.read("strips.ply", bytes);
  CHECK(document.cells.types == std::vector<std::uint8_t>(2, cell_type::triangle_strip));
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 3, 4, 2, 3});
  CHECK(document.cells.offsets == std::vector<std::int64_t>{0, 4, 7});
  CHECK(document.cell_arrays.empty());
  REQUIRE(document.notes.size() == 1);
  CHECK(contains(document.notes[0], "property 'weight' of element 'tristrips' is not read"));
  CHECK(written_back(document) == bytes);
}

TEST_CASE("PLY: faces beside strips keep their arrays, whose rows are 0 for the strips") {
  const std::string bytes = ascii(three + "element tristrips 1\nproperty list int int vertex_index\nelement face 1\n" +
                                      face + "property int region\n",
                                  three_rows + "7 0 1 2 -1 2 1 0\n3 0 1 2 5\n");
  const MeshDocument document = ply_codec.read("both.ply", bytes);
  CHECK(is_valid(document));
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(std::ranges::equal(document.cell_arrays[0].as<std::int32_t>(), std::vector<std::int32_t>{0, 0, 5}));
}

TEST_CASE("PLY: what follows the last row is noted and kept, unless it is another row") {
  const std::string text = ascii(three + "element face 1\n" + face, three_rows + "3 0 1 2\n");
  const std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" + xyz +
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                             std::string(36, '\0') + '\3' + number_bytes(0) + number_bytes(1) + number_bytes(2);
  const std::string row = '\3' + number_bytes(2) + number_bytes(1) + number_bytes(0);
  for (const std::string& tail : {std::string("made by hand\n"), std::string("12 of these"), std::string(16, '\0'),
                                  std::string("\3\0\0\0\0\1\2\3\4zz", 11), std::string("\xff\xfe")}) {
    for (const std::string& file : {text, binary}) {
      CAPTURE(file + tail);
      const MeshDocument document = ply_codec.read("tail.ply", file + tail);
      CHECK(document.cells.size() == 1);
      REQUIRE(document.notes.size() == 1);
      CHECK(contains(document.notes[0], "something follows the last row"));
      CHECK(written_back(document) == file + tail);
    }
  }
  CHECK(contains(refusal(ply_codec, binary + row + "and more"), "got another row of element 'face'"));
  CHECK(contains(refusal(ply_codec, text + "3 2 1 0\n# and more"), "got another row of element 'face'"));
}

TEST_CASE("PLY: a byte-order mark in front of text is no harm") {
  const std::string bytes = "\xEF\xBB\xBF" + square_file(Flavour::ascii);
  const MeshDocument document = ply_codec.read("mark.ply", bytes);
  CHECK(document.points == ply_codec.read("square.ply", square_file(Flavour::ascii)).points);
  CHECK(written_back(document) == bytes);
}

TEST_CASE("PLY: arrays cannot be added to the file that was read, nor points") {
  MeshDocument document = ply_codec.read("square.ply", square_file(Flavour::ascii));
  const TemporaryPath file(".ply");
  const std::vector<DataArray> added{trismooth::make_data_array("fixed", 1, std::vector<std::uint8_t>(5))};
  CHECK_THROWS_AS(document.original->write(file.path(), document, added, {}), trismooth::WriteError);
  CHECK_THROWS_AS(document.original->write(file.path(), document, {}, added), trismooth::WriteError);
  document.points.resize(3);
  CHECK_THROWS_AS(document.original->write(file.path(), document, {}, {}), trismooth::WriteError);
}

}  // namespace trismooth::ply_test

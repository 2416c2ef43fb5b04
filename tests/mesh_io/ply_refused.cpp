// SPDX-License-Identifier: BSD-3-Clause
// Damaged and hostile PLY files.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"
#include "ply_files.h"

namespace trismooth::ply_refused_test {

using namespace byte_files;
using namespace ply_files;

TEST_CASE("PLY: filling up cell arrays takes no more memory than a small multiple of the file's size") {
  std::string declarations = three + "element face 1\n" + face;
  std::string rows = three_rows + "3 0 1 2";
  for (int i = 0; i < 2000; ++i) {
    declarations += "property int p" + std::to_string(i) + "\n";
    rows += " 1";
  }
  declarations += "element edge 2000\nproperty int vertex1\nproperty int vertex2\n";
  rows += "\n";
  for (int i = 0; i < 2000; ++i) {
    rows += "0 1\n";
  }
  const MeshDocument document = ply_codec.read("z.ply", ascii(declarations, rows));
  CHECK(is_valid(document));
  CHECK_FALSE(document.cell_arrays.empty());
  CHECK(document.cell_arrays.size() * 2000 * sizeof(int) < 20 * (declarations.size() + rows.size()));
  CHECK(document.notes.size() == 2000);
}

TEST_CASE("PLY: what does not belong to a planar mesh is refused with its place") {
  struct Case {
    std::string bytes;
    std::string message;
  };
  const std::string good_faces = three + "element face 1\n" + face;
  const std::string strips = three + "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::vector<Case> cases{
      {"", "not a PLY file"},
      {"plyx\n", "not a PLY file"},
      {"ply\n", "end of the file"},
      {"ply\nformat ascii 2.0\n", ":2: expected version 1.0"},
      {"ply\nformat xml 1.0\n", "got 'xml'"},
      {"ply\nformat ascii 1.0\nformat ascii 1.0\n", ":3: the format is declared twice"},
      {"ply\n" + three + "end_header\n" + three_rows, "no format"},
      {ascii("property int x\n", ""), "before any element"},
      {ascii("element vertex -1\n", ""), "from 0"},
      {ascii("element vertex 99999999999999999999\n", ""), ":3: expected a number of rows"},
      {ascii("element vertex\n", ""), "end of the line"},
      {ascii("element vertex 1 2\n", ""), "expected the end of the line, got '2'"},
      {ascii(three + three, ""), "'vertex' is declared twice"},
      {ascii(three + "property float x\n", ""), "'x' of element 'vertex' is declared twice"},
      {ascii("element vertex 1\nproperty quad x\n", ""), "got 'quad'"},
      {ascii("element face 1\nproperty list float int vertex_indices\n", ""), "integer type"},
      {ascii("", ""), "no element 'vertex'"},
      {ascii("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"), "no scalar property 'z'"},
      {ascii("element vertex 1\nproperty int x\nproperty int y\nproperty int z\n", "0 0 0\n"), "integer type int"},
      {ascii(three, "0 0 0\n1 nan 0\n0 1 0\n"), ":9: vertex 1: y is not a finite"},
      {ascii(three, "0 0 0\n1 0 0\n0 1 inf\n"), ":10: vertex 2: z is not a finite"},
      {ascii(three, "0 0 0\n1e39 0 0\n0 1 0\n"), "not a finite float32"},
      {ascii(three, "0 0 0\n1 abc 0\n0 1 0\n"), ":9: expected property 'y' of element 'vertex' (a number), got 'abc'"},
      {ascii(three, "0 0 0\n1 0 0 7\n0 1 0\n"), ":9: vertex 1 has more numbers"},
      {ascii(three, "0 0 0\n1 0 0\n"), "has room for 2 at most"},
      {ascii(three, "0 0 0\n1 0.00000000 0\n"), ":9: the file ends after 2 of 3 rows of element 'vertex'"},
      {ascii(three + "element face 2\n" + face, three_rows + "3 0 1 2\n"), "ends after 1 of 2 rows of element 'face'"},
      {ascii(good_faces, three_rows + "3 0 1 3\n"), ":13: face 0: vertex index 3 is out of range"},
      {ascii(good_faces, three_rows + "3 0 -1 2\n"), "face 0: vertex index -1 is out of range"},
      {ascii(good_faces, three_rows + "3 0 4294967297 2\n"), "got '4294967297'"},
      {ascii(good_faces, three_rows + "2 0 1\n"), "face 0 has 2 vertices"},
      {ascii(good_faces, three_rows + "0\n"), "face 0 has 0 vertices"},
      {ascii(good_faces, three_rows + "200 0 1 2\n"), "face 0 declares a list of 200 numbers"},
      {ascii(three + "element face 1\nproperty list char int vertex_indices\n", three_rows + "-3 0 1 2\n"),
       "list of -3"},
      {ascii(three + "element face 1\nproperty list int int vertex_indices\n", three_rows + "2000000000 0 1 2\n"),
       "room"},
      {ascii(three + "element face 1\nproperty list uchar float vertex_indices\n", three_rows + "3 0 1 2\n"),
       "no list of"},
      {ascii(three + "element face 1\nproperty int region\n", three_rows + "3\n"), "no list of integers"},
      {ascii(strips, three_rows + "4 0 1 3 -1\n"), ":13: tristrips 0: vertex index 3 is out of range"},
      {ascii(strips, three_rows + "4 0 1 2 -2\n"), "tristrips 0: vertex index -2 is out of range"},
      {ascii(strips, three_rows + "6 0 1 2 -1 0 1\n"), ":13: tristrips 0: a strip has 2 vertices, expected 3"},
      {ascii(strips, three_rows + "6 0 -1 0 1 2 -1\n"), "a strip has 1 vertices, expected 3"},
      {ascii(strips, three_rows + "9 0 1 2 -1\n"), "tristrips 0 declares a list of 9 numbers"},
      {ascii(three + "element tristrips 1\nproperty int n\n", three_rows + "0\n"), "'tristrips' has no list of"},
      {ascii(good_faces, three_rows + "3 0 1 2\n3 1 2 0\n"), ":14: expected the end of the file after the rows"},
      {ascii(three + "element face 1\nproperty list uint64 uint64 vertex_indices\n",
             three_rows + "18446744073709551615 0 1 2\n"),
       "face 0 declares a list of 18446744073709551615 numbers"},
      {ascii(three + "element face 1\nproperty list uint64 uint64 vertex_indices\n",
             three_rows + "3 0 1 18446744073709551615\n"),
       "face 0: vertex index 18446744073709551615 is out of range"},
      {ascii(three + "element face 1\nproperty list int64 int64 vertex_indices\n", three_rows + "3 0 1 4294967296\n"),
       "face 0: vertex index 4294967296 is out of range"},
      {ascii("element vertex 3000000000\n" + xyz, three_rows), "more than are supported"},
      {ascii("element vertex 2000000000\n" + xyz, three_rows), "declares 2000000000 rows of element 'vertex'"},
      {ascii(three + "element face 9000000000000000000\n" + face, three_rows), "declares 9000000000000000000 rows"},
      {ascii(three + "element face 1\n" + face + "property uchar red\n", three_rows + "3 0 1 2 256\n"),
       "from 0 to 255"},
  };
  for (const Case& refused : cases) {
    CAPTURE(refused.bytes, refused.message);
    const std::string message = refusal(ply_codec, refused.bytes);
    CAPTURE(message);
    CHECK(contains(message, refused.message));
    CHECK(message.starts_with("mesh:"));
    CHECK_FALSE(contains(message, "\n"));
  }
}

TEST_CASE("PLY: binary faults are refused with their byte") {
  const std::string header = "ply\nformat binary_big_endian 1.0\nelement vertex 3\n" + xyz +
                             "element face 1\nproperty list int uint vertex_indices\nend_header\n";
  const auto big = [](auto number) { return number_bytes(number, std::endian::big); };
  std::string vertices;
  for (const float coordinate : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) {
    vertices += big(coordinate);
  }
  const auto indices = [&](std::uint32_t last) { return big(std::uint32_t{0}) + big(std::uint32_t{1}) + big(last); };
  const auto place = [&](std::size_t offset) { return "byte " + std::to_string(header.size() + offset) + ": "; };
  CHECK(refusal(ply_codec, header + vertices + big(3) + indices(2)).empty());
  CHECK(contains(refusal(ply_codec, header + vertices + big(3) + indices(4294967295U)),
                 place(48) + "face 0: vertex index 4294967295 is out of range"));
  CHECK(contains(refusal(ply_codec, header + vertices + big(-3) + indices(2)),
                 place(36) + "face 0 declares a list of -3"));
  CHECK(contains(refusal(ply_codec, header + vertices + big(2147483647) + indices(2)), place(36) + "face 0 declares"));
  CHECK(contains(refusal(ply_codec, header + vertices.replace(4, 4, big(std::numeric_limits<float>::quiet_NaN())) +
                                        big(3) + indices(2)),
                 place(4) + "vertex 0: y is not a finite"));
}

TEST_CASE("PLY: rows without properties take no time, and bytes after the last row are noted and kept") {
  const std::string bytes = ascii(three + "element nothing 4000000000000000000\n", three_rows + "\n\nthe end");
  const MeshDocument document = ply_codec.read("n.ply", bytes);
  CHECK(document.point_count() == 3);
  CHECK(document.notes.size() == 2);
  CHECK(written_back(document) == bytes);
}

}  // namespace trismooth::ply_refused_test

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"

using namespace byte_files;
using trismooth::DataArray;
using trismooth::find_array;
using trismooth::MeshDocument;
using trismooth::ply_codec;
using trismooth::ScalarType;
namespace cell_type = trismooth::cell_type;

namespace {

enum class Flavour { ascii, little, big };

std::string to_text(Flavour flavour) {
  return flavour == Flavour::ascii    ? "ascii"
         : flavour == Flavour::little ? "binary_little_endian"
                                      : "binary_big_endian";
}

/// Writes rows in one flavour: the tests' own idea of the format.
class Rows {
 public:
  explicit Rows(Flavour flavour) : flavour_(flavour) {}

  template <class T>
  Rows& add(T number, const std::string& text) {
    if (flavour_ == Flavour::ascii) {
      bytes_ += text + " ";
    } else {
      bytes_ += number_bytes(number, flavour_ == Flavour::little ? std::endian::little : std::endian::big);
    }
    return *this;
  }
  template <class T>
  Rows& add(T number) {
    return add(number, std::to_string(number));
  }
  void end() {
    if (flavour_ == Flavour::ascii) {
      bytes_.back() = '\n';
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  Flavour flavour_;
  std::string bytes_;
};

struct Coordinate {
  double value;
  std::string text;
};

using Coordinates = std::vector<std::array<Coordinate, 3>>;

/// A square of two triangles and a quad, its coordinates in texts that no writer would choose.
const Coordinates square{{{{0, "0"}, {0, "-0.0"}, {0, "0e5"}}},
                         {{{1, "1.000"}, {0, "0"}, {0, "0"}}},
                         {{{1, "+1"}, {1, "1e0"}, {0, "0"}}},
                         {{{0, "0"}, {1, "01"}, {0, "0"}}},
                         {{{0.5, ".5"}, {0.25, "0.25"}, {0, "0"}}}};

const std::string square_header_body =
    "comment made by hand\nobj_info nothing\nelement vertex 5\nproperty double x\nproperty uchar red\n"
    "property double y\nproperty double z\nelement camera 1\nproperty list uchar short shape\nproperty float focus\n"
    "element face 3\nproperty char side\nproperty list uchar int vertex_indices\nproperty list int float uv\n"
    "property ushort region\nend_header\n";

/// The square in one flavour: vertex rows of 8 + 1 + 8 + 8 bytes in the binary ones.
std::string square_file(Flavour flavour, const Coordinates& points = square) {
  Rows rows(flavour);
  std::uint8_t red = 250;
  for (const auto& [x, y, z] : points) {
    rows.add(x.value, x.text).add(red++).add(y.value, y.text).add(z.value, z.text).end();
  }
  rows.add(std::uint8_t{2}).add(std::int16_t{-3}).add(std::int16_t{4}).add(1.5F, "1.5").end();
  const std::vector<std::vector<std::int32_t>> faces{{0, 1, 4}, {1, 2, 4}, {2, 3, 0, 4}};
  std::int8_t side = -1;
  for (const auto& face : faces) {
    rows.add(side).add(static_cast<std::uint8_t>(face.size()));
    for (const std::int32_t vertex : face) {
      rows.add(vertex);
    }
    rows.add(std::int32_t{1}).add(0.5F, "0.5").add(static_cast<std::uint16_t>(65533 - side)).end();
    ++side;
  }
  return "ply\nformat " + to_text(flavour) + " 1.0\n" + square_header_body + rows.bytes();
}

std::string ascii(const std::string& declarations, const std::string& rows) {
  return "ply\nformat ascii 1.0\n" + declarations + "end_header\n" + rows;
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string three = "element vertex 3\n" + xyz;
const std::string three_rows = "0 0 0\n1 0 0\n0 1 0\n";
const std::string face = "property list uchar int vertex_indices\n";

}  // namespace

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

TEST_CASE("PLY: a document that did not change gives the file's bytes") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  const std::string bytes = square_file(flavour);
  CHECK(written_back(ply_codec.read("square.ply", bytes)) == bytes);
  const std::string crlf =
      ascii("element vertex 3\r\n" + xyz + "element face 1\n" + face, "0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2");
  CHECK(written_back(ply_codec.read("square.ply", crlf)) == crlf);
}

TEST_CASE("PLY: changed coordinates are the only bytes that change") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  MeshDocument document = ply_codec.read("square.ply", square_file(flavour));
  document.points[12] = 0.1;
  document.points[13] = -1e-300;
  document.points[8] = 1.0 / 3;
  Coordinates moved = square;
  moved[4][0] = {0.1, "0.1"};
  moved[4][1] = {-1e-300, "-1e-300"};
  moved[2][2] = {1.0 / 3, "0.3333333333333333"};
  const std::string written = written_back(document);
  CHECK(written == square_file(flavour, moved));
  CHECK(ply_codec.read("square.ply", written).points == document.points);

  if (flavour != Flavour::ascii) {
    const std::string before = square_file(flavour);
    const std::size_t body = before.find("end_header\n") + 11;
    constexpr std::size_t row = 25;
    REQUIRE(written.size() == before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool in_moved = (i >= body + 4 * row && i < body + 4 * row + 8) ||
                            (i >= body + 4 * row + 9 && i < body + 4 * row + 17) ||
                            (i >= body + 2 * row + 17 && i < body + 2 * row + 25);
      if (!in_moved) {
        REQUIRE(written[i] == before[i]);
      }
    }
  }
}

TEST_CASE("PLY: no truncation gives part of a mesh") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  CAPTURE(to_text(flavour));
  const std::string bytes = square_file(flavour);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    CAPTURE(size);
    try {
      const MeshDocument document = ply_codec.read("cut.ply", bytes.substr(0, size));
      // Only a text can be cut within its last number.
      REQUIRE(flavour == Flavour::ascii);
      REQUIRE(size + 5 >= bytes.size());
      REQUIRE(is_valid(document));
      REQUIRE(document.point_count() == 5);
      REQUIRE(document.cells.size() == 3);
    } catch (const trismooth::ReadError&) {
      SUCCEED();
    }
  }
}

TEST_CASE("PLY: whatever the bytes, a document is valid or refused") {
  const auto flavour = GENERATE(Flavour::ascii, Flavour::little, Flavour::big);
  const std::string bytes = square_file(flavour);
  const std::string tempting = "0123456789 -.e\n\r\xff\x7f\x80";
  std::mt19937 random(1);
  int read = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    std::string damaged = bytes;
    for (unsigned change = 0; change <= random() % 3; ++change) {
      const std::size_t place = random() % damaged.size();
      switch (random() % 3) {
        case 0:
          damaged[place] = tempting[random() % tempting.size()];
          break;
        case 1:
          damaged.erase(place, 1 + random() % 4);
          break;
        default:
          damaged.insert(place, 1, tempting[random() % tempting.size()]);
      }
    }
    try {
      const MeshDocument document = ply_codec.read("damaged.ply", damaged);
      REQUIRE(is_valid(document));
      ++read;
    } catch (const trismooth::ReadError&) {
    }
  }
  CHECK(read > 0);
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

TEST_CASE("PLY: arrays cannot be added to the file that was read, nor points") {
  MeshDocument document = ply_codec.read("square.ply", square_file(Flavour::ascii));
  const TemporaryPath file(".ply");
  const std::vector<DataArray> added{trismooth::make_data_array("fixed", 1, std::vector<std::uint8_t>(5))};
  CHECK_THROWS_AS(document.original->write(file.path(), document, added, {}), trismooth::WriteError);
  CHECK_THROWS_AS(document.original->write(file.path(), document, {}, added), trismooth::WriteError);
  document.points.resize(3);
  CHECK_THROWS_AS(document.original->write(file.path(), document, {}, {}), trismooth::WriteError);
}

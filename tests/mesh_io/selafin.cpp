// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/says.h"
#include "support/small_selafin.h"
#include "support/text_format.h"

namespace trismooth::selafin_test {

using test_support::SmallSelafin;

const TextFormat selafin(".slf");

const std::vector<double> plate_points{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0};

/// Four triangles around a point of a square, up to y.
void add_plate(SmallSelafin& file) {
  file.integers({4, 5, 3, 1});
  file.integers({1, 2, 5, 2, 3, 5, 3, 4, 5, 4, 1, 5});
  file.integers({1, 2, 3, 4, 0});
  file.reals({0, 2, 2, 0, 0.75});
  file.reals({0, 0, 2, 2, 1.25});
}

SmallSelafin plate_with(const std::vector<std::string>& variables, std::size_t steps, bool is_big = true,
                        std::size_t real_size = 8) {
  SmallSelafin file(is_big, real_size);
  file.head(variables, {1, 0, 500000, 4800000, 0, 0, 0, 0, 0, 1});
  add_plate(file);
  for (std::size_t step = 0; step < steps; ++step) {
    file.reals({60.0 * static_cast<double>(step)});
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const auto first = static_cast<double>(10 * i + 100 * step);
      file.reals({first, first + 1, first + 2, first + 3, first + 4});
    }
  }
  return file;
}

TEST_CASE("SELAFIN: both sizes of reals and both orders of bytes are read, and written back byte for byte") {
  for (const bool is_big : {true, false}) {
    for (const std::size_t size : {std::size_t{4}, std::size_t{8}}) {
      const std::string bytes = plate_with({"BOTTOM          M", "WIND"}, 1, is_big, size).bytes();
      MeshDocument document = selafin.read(bytes);
      CHECK(document.format == FileFormat::selafin);
      CHECK(document.points == plate_points);
      CHECK(document.point_type == (size == 4 ? ScalarType::float32 : ScalarType::float64));
      CHECK(document.cells.types == std::vector<std::uint8_t>(4, cell_type::triangle));
      CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
      REQUIRE(document.point_arrays.size() == 2);
      CHECK(document.point_arrays[0].name == "BOTTOM");
      CHECK(document.point_arrays[0].value(4) == 4);
      CHECK(document.point_arrays[0].description->information.front().values == std::vector<std::string>{"M"});
      CHECK(document.point_arrays[1].value(4) == 14);
      CHECK(document.arrays_of_places == std::vector<std::string>{"BOTTOM"});
      CHECK(document.notes.empty());
      REQUIRE(document.losses.size() == 1);
      CHECK(says(document.losses[0], "(500000, 4800000)"));
      CHECK(selafin.written(document) == bytes);
      // Moved: the bytes of one number of x and of y, and of a value.
      document.points[12] = 1;
      document.points[13] = 1.5;
      document.point_arrays[0] = size == 4 ? make_data_array("BOTTOM", 1, std::vector<float>{0, 1, 2, 3, 7})
                                           : make_data_array("BOTTOM", 1, std::vector<double>{0, 1, 2, 3, 7});
      SmallSelafin expected(is_big, size);
      expected.head({"BOTTOM          M", "WIND"}, {1, 0, 500000, 4800000, 0, 0, 0, 0, 0, 1});
      expected.integers({4, 5, 3, 1});
      expected.integers({1, 2, 5, 2, 3, 5, 3, 4, 5, 4, 1, 5});
      expected.integers({1, 2, 3, 4, 0});
      expected.reals({0, 2, 2, 0, 1});
      expected.reals({0, 0, 2, 2, 1.5});
      expected.reals({0});
      expected.reals({0, 1, 2, 3, 7});
      expected.reals({10, 11, 12, 13, 14});
      CHECK(selafin.written(document) == expected.bytes());
    }
  }
}

TEST_CASE("SELAFIN: of several time steps the last one's values are read, and all are kept") {
  const std::string bytes = plate_with({"WATER DEPTH     M"}, 3).bytes();
  MeshDocument document = selafin.read(bytes);
  CHECK(values_of<double>(document.point_arrays, "WATER DEPTH") == std::vector<double>{200, 201, 202, 203, 204});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "the last of 3 time steps, t = 120"));
  CHECK_FALSE(writes_values_of(document, FileFormat::selafin, "WATER DEPTH"));
  CHECK(selafin.written(document) == bytes);
}

TEST_CASE("SELAFIN: quadrilaterals are read, and pieces of a parallel run have their numbers in the whole as labels") {
  SmallSelafin squares;
  squares.head();
  squares.integers({1, 4, 4, 1});
  squares.integers({1, 2, 3, 4});
  squares.integers({1, 2, 3, 4});
  squares.reals({0, 1, 1, 0});
  squares.reals({0, 0, 1, 1});
  CHECK(selafin.read(squares.bytes()).cells.types == std::vector<std::uint8_t>{cell_type::quad});
  SmallSelafin piece;
  piece.head({}, {1, 0, 0, 0, 0, 0, 0, 3, 2, 0});
  piece.integers({1, 3, 3, 1});
  piece.integers({1, 2, 3});
  piece.integers({70, 8, 90});
  piece.reals({0, 1, 1});
  piece.reals({0, 0, 1});
  const MeshDocument document = selafin.read(piece.bytes());
  CHECK(document.point_labels == std::vector<std::int64_t>{70, 8, 90});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "a piece of a mesh"));
}

TEST_CASE("SELAFIN: a mesh from elsewhere has its boundary numbered, its values as variables, and comes back") {
  // A ring of squares around a hole, of two triangles each; the bottom as a depth.
  MeshDocument document;
  for (int y = 0; y <= 3; ++y) {
    for (int x = 0; x <= 3; ++x) {
      document.points.insert(document.points.end(), {static_cast<double>(x), static_cast<double>(y), 0});
    }
  }
  for (std::int32_t y = 0; y < 3; ++y) {
    for (std::int32_t x = 0; x < 3; ++x) {
      const std::int32_t a = 4 * y + x;
      if (x != 1 || y != 1) {
        document.cells.append(cell_type::triangle, std::vector<std::int32_t>{a, a + 1, a + 5});
        document.cells.append(cell_type::triangle, std::vector<std::int32_t>{a, a + 5, a + 4});
      }
    }
  }
  std::vector<double> depths(16, 2.5);
  document.point_arrays = {make_data_array("depth", 1, depths),
                           make_data_array("a velocity of the water", 2, std::vector<float>(32, 1.5F)),
                           make_data_array("count", 1, std::vector<std::int32_t>(16, 3))};
  document.cell_arrays = {make_data_array("region", 1, std::vector<std::int32_t>(document.cells.size(), 3))};
  const std::string bytes = selafin.written(document);
  SmallSelafin head;
  head.head({"BOTTOM", "a velocity of th", "a velocity of _1", "count"});
  // All but the title.
  CHECK(bytes.substr(88, head.bytes().size() - 88) == head.bytes().substr(88));
  SmallSelafin numbers;
  numbers.integers({1, 2, 3, 4, 12, 13, 16, 5, 11, 14, 15, 6, 10, 9, 8, 7});
  CHECK(bytes.find(numbers.bytes()) != std::string::npos);
  const MeshDocument again = selafin.read(bytes);
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(values_of<double>(again.point_arrays, "BOTTOM") == std::vector<double>(16, -2.5));
  CHECK(values_of<double>(again.point_arrays, "count") == std::vector<double>(16, 3));
  const std::vector<std::string> lost = what_is_lost(document, FileFormat::selafin);
  REQUIRE(lost.size() == 5);
  CHECK(says(lost[0], "holds no cell arrays: region"));
  CHECK(says(lost[1], "depth is written as BOTTOM"));
  CHECK(says(lost[2], "the components of a velocity of the water"));
  CHECK(says(lost[3], "16 characters at most"));
  CHECK(says(lost[4], "the whole ones of count"));
}

TEST_CASE("SELAFIN: what cannot be a plane mesh is refused with what to do") {
  const auto refused = [](const std::vector<std::int32_t>& parameters, const std::vector<std::int32_t>& sizes,
                          const std::vector<std::int32_t>& nodes, const std::vector<double>& x) {
    SmallSelafin file;
    file.head({}, parameters);
    file.integers(sizes);
    file.integers(nodes);
    file.integers({1, 2, 3});
    file.reals(x);
    file.reals({0, 0, 1});
    return selafin.failure_of(file.bytes());
  };
  const std::vector<std::int32_t> plain{1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  CHECK(refused(plain, {1, 3, 3, 1}, {1, 2, 3}, {0, 1, 1}).empty());
  CHECK(says(refused({1, 0, 0, 0, 0, 0, 10, 0, 0, 0}, {1, 3, 3, 1}, {1, 2, 3}, {0, 1, 1}),
             "is a mesh of 10 planes (3D), which is not read: smooth the plane mesh"));
  CHECK(says(refused(plain, {1, 3, 6, 1}, {1, 2, 3}, {0, 1, 1}), "prisms (3D)"));
  CHECK(says(refused(plain, {1, 3, 2, 1}, {1, 2, 3}, {0, 1, 1}), "elements of 2 nodes"));
  CHECK(says(refused(plain, {1, 3, 3, 1}, {1, 2, 4}, {0, 1, 1}), "element 1 names node 4; the file has 3"));
  CHECK(says(refused(plain, {2, 3, 3, 1}, {1, 2, 3}, {0, 1, 1}), "12 bytes of elements, expected 24"));
  CHECK(says(refused(plain, {2147483647, 2147483647, 3, 1}, {1, 2, 3}, {0, 1, 1}), "bytes of elements"));
  CHECK(says(refused(plain, {-1, 3, 3, 1}, {}, {0, 1, 1}), "has no numbers of elements"));
  CHECK(says(refused(plain, {1, 3, 3, 1}, {1, 2, 3}, {0, 1, std::numeric_limits<double>::infinity()}),
             "node 3 has a coordinate that is no finite number"));
  CHECK(says(refused(plain, {1, 3, 3, 1}, {1, 2, 3}, {0, 1}), "16 bytes of x, expected 4 or 8 for each of 3"));
  const std::string bytes = plate_with({"WIND"}, 1).bytes();
  CHECK(says(selafin.failure_of(bytes.substr(0, bytes.size() - 1)), "ends before its WIND in time step 1 does"));
  std::string damaged = bytes;
  damaged.back() = 'x';
  CHECK(says(selafin.failure_of(damaged), "two counts of bytes around its WIND in time step 1 that differ"));
  CHECK(says(selafin.failure_of(std::string(100, 'x')), "does not begin as SELAFIN does"));
}

}  // namespace trismooth::selafin_test

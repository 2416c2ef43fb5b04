// SPDX-License-Identifier: BSD-3-Clause
// Legacy files whose coordinates are whole numbers: nothing moves, nothing changes; a vertex that moves to another
// whole number changes that number; one that moves between them makes the file's type double.

#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_promotion.h"

#include <limits>

#include "vtk_legacy_files.h"

using legacy_test::Builder;
using legacy_test::TemporaryFile;
using trismooth::MeshDocument;

namespace whole_points {

template <class T>
std::string file(bool binary, const std::string& type, const std::vector<T>& points) {
  Builder builder(binary, "3.0", "UNSTRUCTURED_GRID");
  builder.text("POINTS " + std::to_string(points.size() / 3) + " " + type + "  \n").numbers(points);
  builder.cells("CELLS", {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, false);
  builder.text("CELL_TYPES 4\n").numbers(std::vector{5, 5, 5, 5});
  builder.text("CELL_DATA 4\nSCALARS region int 1\nLOOKUP_TABLE default\n").numbers(std::vector{1, 1, 2, 2});
  return builder.bytes();
}

template <class T>
std::vector<T> square() {
  return {0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0, 3, 7, 0};
}

/// The bytes that differ are those of `from` to `to`, which became `by`.
void check_replaced(std::string bytes, const std::string& from, const std::string& to, const std::string& result) {
  const std::size_t at = bytes.find(from);
  REQUIRE(at != std::string::npos);
  CHECK(bytes.replace(at, from.size(), to) == result);
}

}  // namespace whole_points

TEST_CASE("legacy VTK: whole coordinates of every type are read as VTK reads them and written back as they were") {
  const bool binary = GENERATE(false, true);
  const auto check = [&](const std::string& type, auto zero) {
    CAPTURE(binary, type);
    using T = decltype(zero);
    const TemporaryFile source(whole_points::file(binary, type, whole_points::square<T>()), ".vtk");
    const MeshDocument document = trismooth::read_mesh(source.path());
    legacy_test::check_same(document, legacy_test::read_with_vtk(source.path()));
    CHECK(document.point_type == trismooth::ScalarType::float64);
    const TemporaryFile target;
    trismooth::write_mesh(target.path(), document);
    CHECK(target.bytes() == source.bytes());
  };
  check("char", std::int8_t{});
  check("unsigned_char", std::uint8_t{});
  check("short", std::int16_t{});
  check("unsigned_short", std::uint16_t{});
  check("int", std::int32_t{});
  check("unsigned_int", std::uint32_t{});
  check("long", std::int64_t{});
  check("vtktypeuint64", std::uint64_t{});
}

TEST_CASE("legacy VTK: a vertex that moves to whole coordinates leaves the file's type") {
  const TemporaryFile source(whole_points::file(false, "int", whole_points::square<std::int32_t>()), ".vtk");
  MeshDocument document = trismooth::read_mesh(source.path());
  document.points[12] = 5;
  document.points[13] = -5;
  const TemporaryFile target;
  trismooth::write_mesh(target.path(), document);
  whole_points::check_replaced(source.bytes(), "3 7 0", "5 -5 0", target.bytes());
  legacy_test::check_same(trismooth::read_mesh(target.path()), legacy_test::read_with_vtk(target.path()));
}

TEST_CASE("legacy VTK: a vertex that moves between whole coordinates makes the type double and nothing else") {
  const bool binary = GENERATE(false, true);
  const auto [x, y] = GENERATE(std::pair(4.75, 5.0), std::pair(40000.0, 7.0), std::pair(-0.0, 7.0));
  CAPTURE(binary, x, y);
  const auto square = whole_points::square<std::int16_t>();
  const TemporaryFile source(whole_points::file(binary, "short", square), ".vtk");
  MeshDocument document = trismooth::read_mesh(source.path());
  document.points[12] = x;
  document.points[13] = y;
  const TemporaryFile target;
  trismooth::write_mesh(target.path(), document, {.point_arrays = {}, .cell_arrays = {}});
  std::vector<double> moved(square.begin(), square.end());
  moved[12] = x;
  moved[13] = y;
  if (binary) {
    CHECK(target.bytes() == whole_points::file(binary, "double", moved));
  } else {
    std::string expected = source.bytes();
    expected.replace(expected.find("short"), 5, "double");
    const std::string number = x == 4.75 ? "4.75 5 0" : x == 40000 ? "40000 7 0" : "-0 7 0";
    whole_points::check_replaced(expected, "3 7 0", number, target.bytes());
  }
  const MeshDocument again = trismooth::read_mesh(target.path());
  CHECK(std::ranges::equal(std::as_bytes(std::span(again.points)), std::as_bytes(std::span(document.points))));
  legacy_test::check_same(again, legacy_test::read_with_vtk(target.path()));
  // Written again, it is the same file.
  const TemporaryFile twice;
  trismooth::write_mesh(twice.path(), again);
  CHECK(twice.bytes() == target.bytes());
}

TEST_CASE("legacy VTK: arrays are added behind a file whose type becomes double") {
  const bool binary = GENERATE(false, true);
  const TemporaryFile source(whole_points::file(binary, "int", whole_points::square<std::int32_t>()), ".vtk");
  MeshDocument document = trismooth::read_mesh(source.path());
  document.points[12] = 0.1;
  const TemporaryFile target;
  trismooth::write_mesh(target.path(), document,
                        {.point_arrays = {trismooth::make_data_array("p", 1, std::vector<double>{1, 2, 3, 4, 5})},
                         .cell_arrays = {trismooth::make_data_array("c", 1, std::vector<float>{1, 2, 3, 4})}});
  const MeshDocument again = trismooth::read_mesh(target.path());
  CHECK(again.points[12] == 0.1);
  CHECK(again.cell_arrays.size() == 2);
  legacy_test::check_same(again, legacy_test::read_with_vtk(target.path()));
}

TEST_CASE("the limits of whole numbers are those of their types, and -0 is none of them") {
  trismooth::VtkLegacyLayout layout;
  const auto holds = [&](trismooth::ScalarType type, double value) {
    layout.coordinates.type = type;
    return trismooth::holds_coordinates(layout, std::array{0.0, value});
  };
  using enum trismooth::ScalarType;
  CHECK((holds(int8, 127) && holds(int8, -128) && !holds(int8, 128) && !holds(int8, -129) && !holds(int8, 0.5)));
  CHECK((holds(uint64, 18446744073709549568.0) && !holds(uint64, 18446744073709551616.0) && !holds(uint64, -1)));
  CHECK((holds(int64, -9223372036854775808.0) && !holds(int64, 9223372036854775808.0)));
  CHECK((!holds(int32, -0.0) && holds(float64, -0.0) && !holds(int64, std::numeric_limits<double>::infinity())));
}

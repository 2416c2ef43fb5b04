// SPDX-License-Identifier: BSD-3-Clause
// Files that are cut, changed or wrong: each is refused with the place and the reason, or read whole.

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"

#include "byte_files.h"
#include "support/sanitized.h"
#include "vtk_legacy_files.h"

namespace vtk_legacy_damaged_test {

using namespace legacy_test;
using trismooth::MeshDocument;
using trismooth::read_mesh;
using trismooth::ReadError;

MeshDocument read_bytes(const std::string& bytes) {
  return read_mesh(TemporaryFile(bytes, ".vtk").path());
}

/// The message of the ReadError that the bytes cause; empty where they are read.
std::string error_of(const std::string& bytes) {
  const TemporaryFile file(bytes, ".vtk");
  try {
    read_mesh(file.path());
  } catch (const ReadError& error) {
    const std::string message = error.what();
    const std::string path = file.path().string();
    REQUIRE(message.substr(0, path.size()) == path);
    CHECK(message.find('\n') == std::string::npos);
    return message.substr(path.size());
  }
  return {};
}

TEST_CASE("legacy VTK: integers have the width that their type says") {
  const auto array_of = [](const std::string& type, const std::string& value) {
    return "FIELD f 1\na 1 1 " + type + "\n" + value + "\n";
  };
  const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n";
  const std::string tail = "POINTS 1 float\n0 0 0\nVERTICES 1 2\n1 0\n";
  const MeshDocument largest = read_bytes(head + array_of("unsigned_long", "18446744073709551615") + tail);
  CHECK(largest.field_arrays[0].as<std::uint64_t>()[0] == std::numeric_limits<std::uint64_t>::max());
  const std::vector<std::pair<std::string, std::string>> wrong{{"char", "128"},
                                                               {"unsigned_char", "-1"},
                                                               {"unsigned_char", "256"},
                                                               {"short", "40000"},
                                                               {"int", "2147483648"},
                                                               {"unsigned_int", "4294967296"},
                                                               {"long", "9223372036854775808"},
                                                               {"unsigned_long", "18446744073709551616"},
                                                               {"int", "1.5"},
                                                               {"float", "one"},
                                                               {"int", "nan"}};
  for (const auto& [type, value] : wrong) {
    CAPTURE(type, value);
    const std::string message = error_of(head + array_of(type, value) + tail);
    CHECK(message.find(":7: ") == 0);
    CHECK(message.find("'" + value + "'") != std::string::npos);
  }
}

TEST_CASE("legacy VTK: a line of one point is refused") {
  CHECK(error_of("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\n"
                 "LINES 1 2\n1 0\n") == ":8: cell 0 of LINES of type 4 has 1 vertex; expected 2 or more");
}

TEST_CASE("legacy VTK: malformed files are refused with the place and the reason") {
  const std::string good = grid_file(false, false)
                               .text(
                                   "POINT_DATA 9\nSCALARS s int 1\nLOOKUP_TABLE default\n"
                                   "1 2 3 4 5 6 7 8 9\n")
                               .bytes();
  REQUIRE(error_of(good).empty());
  struct Fault {
    std::string what;
    std::string with;
    std::string message;
  };
  const std::vector<Fault> faults{
      {"# vtk DataFile", "# vtk Datafile_", ":1: expected '# vtk DataFile Version'"},
      {"3.0", "9.9", ":1: file version '9.9' is not supported"},
      {"ASCII", "ASCIZ", ":3: expected ASCII or BINARY, got 'ASCIZ'"},
      {"UNSTRUCTURED_GRID", "STRUCTURED_GRID", ":4: dataset type 'STRUCTURED_GRID' is not supported"},
      {"POINTS 9 double", "POINTS 8 double", ":6: unknown keyword"},
      {"POINTS 9 double", "POINTS 10 double", ":7: expected a coordinate (a number), got 'CELLS'"},
      {"POINTS 9 double", "POINTS 9 int", ":6: expected a coordinate (a whole number from -2147483648"},
      {"POINTS 9 double", "POINTS 9 bit", ":5: coordinates must be numbers"},
      {"POINTS 9 double\n0 0", "POINTS 9 long\n0 9007199254740993",
       ":6: a coordinate of point 0 is 9007199254740993, which double precision does not hold"},
      {"POINTS 9 double", "POINTS 9 quad", ":5: expected a data type"},
      {"POINTS 9 double", "POINTS 900000000000 double", ":5: declares 900000000000 points; at most 2147483647"},
      {"POINTS 9 double", "POINTS 2000000000 double", ":5: declares 6000000000 coordinates, but the rest"},
      {"POINTS 9 double", "POINTS 99999999999999999999 double", ":5: expected the number of points"},
      {"POINTS 9 double\n0 ", "POINTS 9 double\nnan ", ":6: a coordinate of point 0 is not a finite number"},
      {"POINTS 9 double\n0 ", "POINTS 9 double\n1e999 ", ":6: a coordinate of point 0 is not a finite number"},
      {"CELLS 7 30", "CELLS 7 29", ":8: cell 6 of CELLS has 5 vertices, but of the size declared (29) only 4"},
      {"CELLS 7 30", "CELLS 7 31", ":8: CELLS declares a size of 31, but its 7 cells take 30"},
      {"CELLS 7 30", "CELLS 6 30", ":8: CELLS declares a size of 30, but its 6 cells take 24"},
      {"CELLS 7 30", "CELLS 30 7", ":7: CELLS declares 30 cells in 7 integers"},
      {"CELLS 7 30", "CELLS 7 -30", ":7: expected the number of integers in CELLS"},
      {"CELLS 7 30", "CELLS 7 4000000000", ":7: declares 4000000000 integers in CELLS, but the rest"},
      {"3 1 2 5", "3 1 2 9", ":8: cell 3 of CELLS has vertex 9, but the file has 9 points"},
      {"3 1 2 5", "3 1 2 4294967298", ":8: cell 3 of CELLS has vertex 4294967298"},
      {"3 1 2 5", "3 1 -2 5", ":8: cell 3 of CELLS has vertex -2"},
      {"3 1 2 5", "3 1 2.0 5", ":8: expected a vertex of a cell (a whole number"},
      {"CELL_TYPES 7", "CELL_TYPES 6", ":9: declares 6 cell types for 7 cells"},
      {"3 5 5 5 5 9 7", "3 5 5 5 9 9 7", ":10: cell 4 of type 9 has 3 vertices; expected 4"},
      {"3 5 5 5 5 9 7", "3 5 5 5 5 5 7", ":10: cell 5 of type 5 has 4 vertices; expected 3"},
      {"3 5 5 5 5 9 7", "5 5 5 5 5 9 7", ":10: cell 0 of type 5 has 2 vertices; expected 3"},
      {"3 5 5 5 5 9 7", "3 5 5 5 5 9 42", ":10: cell 6 is a polyhedron"},
      {"3 5 5 5 5 9 7", "3 5 5 5 5 9 256", ":10: cell 6 has the type 256"},
      {"POINT_DATA 9", "POINT_DATA 8", ":11: POINT_DATA declares 8 rows; expected 9"},
      {"POINT_DATA 9", "CELL_DATA 9", ":11: CELL_DATA declares 9 rows; expected 7"},
      {"SCALARS s int 1", "SCALERS s int 1", ":12: unknown keyword 'SCALERS'"},
      {"SCALARS s int 1", "SCALARS s int 0", ":12: expected the number of components"},
      {"SCALARS s int 1", "SCALARS s int 4", ":13: declares 36 values of point array 's', but the rest"},
      {"SCALARS s int 1", "SCALARS s int 400", ":13: declares 3600 values of point array 's', but the rest"},
      {"SCALARS s int 1\nLOOKUP_TABLE default", "FIELD f 1\ns 1 8 int", ":13: point array 's' has 8 rows; expected 9"},
      {"SCALARS s int 1\nLOOKUP_TABLE default", "FIELD f 2\ns 1 9 int", ":15: expected the name of an array"},
      {"SCALARS s int 1\nLOOKUP_TABLE default", "FIELD f 1\ns 1 9 string",
       ":15: expected values of point array 's', got the end of the file"},
      {"SCALARS s int 1\nLOOKUP_TABLE default", "LOOKUP_TABLE t 9223372036854775807",
       ":12: declares 9223372036854775807 x 4 colours, more than any file holds"},
      {"LOOKUP_TABLE default", "LOOKUP", ":13: expected values of point array 's' (a whole number"},
      {"7 8 9\n", "7 8\n", ":15: expected values of point array 's', got the end of the file"},
      {"7 8 9\n", "7 8 9 10\n", ":14: unknown keyword '10'"},
      {"7 8 9\n", "7 8 9\nMETADATA\nCOMPONENT_NAMES\n", ":16: COMPONENT_NAMES: expected 1 lines, got 0"},
  };
  for (const Fault& fault : faults) {
    CAPTURE(fault.what, fault.with);
    std::string bad = good;
    const std::size_t at = bad.find(fault.what);
    REQUIRE(at != std::string::npos);
    bad.replace(at, fault.what.size(), fault.with);
    const std::string message = error_of(bad);
    CAPTURE(message);
    CHECK(message.substr(0, fault.message.size()) == fault.message);
  }
}

TEST_CASE("legacy VTK: sections that are missing, double or out of order are refused") {
  const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ";
  const std::string points = "POINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
  const std::string cells = "CELLS 1 4\n3 0 1 2\n";
  const std::string types = "CELL_TYPES 1\n5\n";
  CHECK(error_of(head + "UNSTRUCTURED_GRID\n" + points + cells + types).empty());
  for (const std::string& body :
       {points, points + cells, points + types, cells + types, cells + points + types, points + types + cells,
        points + cells + types + cells, points + points + cells + types, points + "POINT_DATA 3\n" + cells + types,
        points + cells + types + "POLYGONS 1 4\n3 0 1 2\n", std::string()}) {
    CAPTURE(body);
    CHECK(error_of(head + "UNSTRUCTURED_GRID\n" + body).find(": ") != std::string::npos);
  }
  CHECK(error_of(head + "POLYDATA\n" + points).find("expected VERTICES, LINES, POLYGONS") != std::string::npos);
  CHECK_FALSE(error_of(head + "POLYDATA\n" + points + cells + types).empty());
  CHECK_FALSE(error_of("").empty());
}

TEST_CASE("legacy VTK: offsets that do not fit are refused") {
  const auto file = [](const std::string& offsets, const std::string& type = "vtktypeint64") {
    return "# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
           "CELLS 3 6\nOFFSETS " +
           type + "\n" + offsets + "\nCONNECTIVITY vtktypeint32\n0 1 2 0 2 3\nCELL_TYPES 2\n5 5\n";
  };
  CHECK(error_of(file("0 3 6")).empty());
  CHECK(error_of(file("0 3 6", "int")).empty());
  CHECK(error_of(file("0 3 6", "double")).find(":8: expected a type of integers") == 0);
  CHECK(error_of(file("0 4 3")).find(":9: offset 2 of CELLS is 3; expected at least 4") == 0);
  CHECK(error_of(file("1 3 6")).find(":9: offset 0 of CELLS is 1; expected 0") == 0);
  CHECK(error_of(file("0 3 7")).find(":9: the offsets of CELLS end at 7, but 6 vertices are declared") == 0);
  CHECK(error_of(file("0 -3 6")).find(":9: offset 1") == 0);
  CHECK(error_of(file("0 3 18446744073709551622")).find(":9: expected an offset") == 0);
}

TEST_CASE("legacy VTK: faults in binary files are reported with their byte offset") {
  const std::string good = grid_file(true, false).bytes();
  const std::size_t cells = good.find("CELLS 7 30\n") + 11;
  std::string bad = good;
  bad[cells + 19] = 9;  // a vertex of the second cell
  CHECK(error_of(bad) ==
        ": at byte " + std::to_string(cells + 16) + ": cell 1 of CELLS has vertex 9, but the file has 9 points");
  bad = good;
  bad[good.find("double\n") + 7] = '\x7f';
  bad[good.find("double\n") + 8] = '\xf0';
  CHECK(error_of(bad) ==
        ": at byte " + std::to_string(good.find("double\n") + 7) + ": a coordinate of point 0 is not a finite number");
  bad = good;
  bad.replace(good.find("POINTS 9"), 8, "POINTS 90000000");
  CHECK(error_of(bad).find("declares 270000000 coordinates, but the rest of the file has room for") !=
        std::string::npos);
}

TEST_CASE("legacy VTK: a keyword in place of any token never does more than cause an error") {
  const bool with_offsets = GENERATE(false, true);
  const bool poly_data = GENERATE(false, true);
  Builder file = poly_data ? poly_data_file(false, with_offsets) : grid_file(false, with_offsets);
  file.text("POINT_DATA 9\n");
  add_attributes(file, 9, false, "p_");
  const std::string& good = file.bytes();
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < good.size(); begin = good.find_first_not_of(" \n", end)) {
    end = std::min(good.find_first_of(" \n", begin), good.size());
    for (const std::string token : {"nan", "double", "bit", "string", "variant", "METADATA", "FIELD", "CELL_DATA"}) {
      if (is_sanitized && begin % 3 != token.size() % 3) {
        continue;
      }
      std::string bytes = good;
      bytes.replace(begin, end - begin, token);
      INFO(token << " at byte " << begin);
      std::optional<trismooth::MeshDocument> document;
      try {
        document = trismooth::vtk_legacy_codec.read("hostile.vtk", bytes);
      } catch (const ReadError&) {
        continue;
      }
      CHECK(byte_files::is_valid(*document));
    }
  }
}

}  // namespace vtk_legacy_damaged_test

#include "trismooth/mesh_io/vtk_legacy_reader.h"

#include <cmath>

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGridWriter.h>

#include "trismooth/mesh_io/errors.h"

#include "vtk_legacy_files.h"

using namespace legacy_test;
using trismooth::find_array;
using trismooth::MeshDocument;
using trismooth::read_mesh;
using trismooth::ReadError;
using trismooth::ScalarType;

namespace {

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

template <class T>
std::vector<T> count_up(std::size_t count, double from, double step) {
  std::vector<T> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<T>(from + step * static_cast<double>(i)));
  }
  return values;
}

/// Every kind of attribute that the format has, `n` rows each.
void add_attributes(Builder& file, std::size_t n, bool binary, const std::string& prefix) {
  const std::string rows = std::to_string(n);
  file.text("SCALARS " + prefix + "scalars%20of%20float float\nLOOKUP_TABLE default\n")
      .numbers(count_up<float>(n, 0.1, 0.3));
  file.text("SCALARS " + prefix + "pairs short 2\nLOOKUP_TABLE table\n").numbers(count_up<std::int16_t>(2 * n, -3, 1));
  file.text("LOOKUP_TABLE table 2\n");
  if (binary) {
    file.numbers(std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 10, 13});
  } else {
    file.text("1 0 0 1\n0 0 0.5 1\n");
  }
  file.text("COLOR_SCALARS " + prefix + "colours 3\n");
  if (binary) {
    file.numbers(count_up<std::uint8_t>(3 * n, 5, 4));
  } else {
    file.numbers(count_up<float>(3 * n, 0, 0.02));
  }
  file.text("vectors " + prefix + "velocity double\n").numbers(count_up<double>(3 * n, -1, 1.0 / 7));
  file.text("Normals " + prefix + "normal float\n").numbers(count_up<float>(3 * n, -1, 0.25));
  file.text("TEXTURE_COORDINATES " + prefix + "uv 2 float\n").numbers(count_up<float>(2 * n, 0, 0.125));
  file.text("TENSORS " + prefix + "stress double\n").numbers(count_up<double>(9 * n, 1e-300, 1e-301));
  file.text("TENSORS6 " + prefix + "strain float\n").numbers(count_up<float>(6 * n, 3, 0.1));
  file.text("GLOBAL_IDS " + prefix + "gid vtkIdType\n").numbers(count_up<std::int32_t>(n, 100, 3));
  file.text("PEDIGREE_IDS " + prefix + "pid int\n").numbers(count_up<std::int32_t>(n, -5, 2));
  file.text("FIELD FieldData 12\n");
  file.text(prefix + "bits 1 " + rows + " bit\n");
  if (binary) {
    file.numbers(std::vector<std::uint8_t>((n + 7) / 8, 0xb5));
  } else {
    file.numbers(std::vector<int>(n, 1));
  }
  file.text("NULL_ARRAY\n");
  file.text(prefix + "c 1 " + rows + " char\n").numbers(count_up<std::int8_t>(n, -4, 1));
  file.text(prefix + "uc 1 " + rows + " unsigned_char\n").numbers(count_up<std::uint8_t>(n, 250 - 9.0, 1));
  file.text(prefix + "us 2 " + rows + " unsigned_short\n").numbers(count_up<std::uint16_t>(2 * n, 65000, 1));
  file.text(prefix + "ui 1 " + rows + " unsigned_int\n").numbers(count_up<std::uint32_t>(n, 4294967000.0, 1));
  file.text(prefix + "l 1 " + rows + " long\n").numbers(count_up<std::int64_t>(n, -9e18, 1e6));
  file.text(prefix + "ul 1 " + rows + " unsigned_long\n").numbers(count_up<std::uint64_t>(n, 1.8e19, 1e6));
  file.text(prefix + "i64 1 " + rows + " vtktypeint64\n").numbers(count_up<std::int64_t>(n, -9e18, 1e6));
  file.text(
      "METADATA\nCOMPONENT_NAMES\nSCALARS%20of\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\n"
      "DATA 2 0 1 \n\n");
  file.text(prefix + "u64 1 " + rows + " vtktypeuint64\n").numbers(count_up<std::uint64_t>(n, 1.8e19, 1e6));
  file.text(prefix + "words 1 " + rows + " string\n");
  for (std::size_t i = 0; i < n; ++i) {
    const std::string word(i, 'x');
    file.text(binary ? std::string(1, static_cast<char>(0xc0 | i)) + word : word + "\n");
  }
  file.text("\n" + prefix + "last 3 " + rows + " double\n").numbers(count_up<double>(3 * n, 0.7, 1e-9));
}

constexpr std::size_t attribute_count = 20;

/// A POLYDATA whose sections stand in another order than VTK's.
Builder poly_data_file(bool binary, bool with_offsets) {
  Builder file(binary, with_offsets ? "5.1" : "2.0", "POLYDATA");
  file.text("POINTS 9 float\n").numbers(grid_points_as<float>());
  file.cells("TRIANGLE_STRIPS", {{3, 4, 6, 7}}, with_offsets);
  file.cells("POLYGONS", {{0, 1, 4}, {1, 2, 5, 4}, {4, 5, 8, 7, 3}}, with_offsets);
  file.cells("LINES", {{0, 1}, {0, 3, 6}}, with_offsets);
  file.cells("VERTICES", {{8}, {2, 5}}, with_offsets);
  return file;
}

}  // namespace

TEST_CASE("legacy VTK: every kind of attribute comes out as VTK reads it") {
  const bool binary = GENERATE(false, true);
  const bool with_offsets = GENERATE(false, true);
  const bool poly_data = GENERATE(false, true);
  CAPTURE(binary, with_offsets, poly_data);
  Builder file = poly_data ? poly_data_file(binary, with_offsets) : grid_file(binary, with_offsets);
  const std::size_t cell_count = poly_data ? 8 : 7;
  file.text("POINT_DATA 9\n");
  add_attributes(file, 9, binary, "p_");
  file.text("EDGE_FLAGS flags int\n").numbers(std::vector<std::int32_t>(9, 1));
  file.text("CELL_DATA " + std::to_string(cell_count) + "\n");
  add_attributes(file, cell_count, binary, "c_");
  const TemporaryFile temporary(file.bytes(), ".vtk");

  const MeshDocument document = read_mesh(temporary.path());
  CHECK(document.point_arrays.size() == attribute_count + 1);
  CHECK(document.cell_arrays.size() == attribute_count);
  CHECK(find_array(document.point_arrays, "p_scalars of float") != nullptr);
  CHECK(document.notes.size() == 4);  // a table and an array of strings each
  check_same(document, read_with_vtk(temporary.path()));
}

TEST_CASE("legacy VTK: what VTK's writers wrote is read as it was") {
  const bool binary = GENERATE(false, true);
  const int version =
      GENERATE(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1);
  const bool poly_data = GENERATE(false, true);
  CAPTURE(binary, version, poly_data);
  const TemporaryFile source((poly_data ? poly_data_file(false, false) : grid_file(false, false)).bytes(), ".vtk");
  const vtkSmartPointer<vtkPointSet> data = read_with_vtk(source.path());
  vtkNew<vtkDoubleArray> named;
  named->SetName("100% \"named\" array");
  named->SetNumberOfComponents(2);
  named->SetNumberOfTuples(data->GetNumberOfPoints());
  named->Fill(0.125);
  named->SetComponentName(1, "second only");
  data->GetPointData()->AddArray(named);
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  words->InsertNextValue("");
  words->InsertNextValue("two words");
  words->InsertNextValue(std::string(100, 'y'));
  words->InsertNextValue(std::string(20000, 'z'));
  data->GetFieldData()->AddArray(words);
  vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    bits->InsertNextValue(i % 3 == 0 ? 1 : 0);
  }
  data->GetCellData()->AddArray(bits);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    ids->InsertNextValue(1000 * i);
  }
  data->GetCellData()->SetGlobalIds(ids);
  vtkNew<vtkFloatArray> time;
  time->SetName("TIME");
  time->InsertNextValue(12.5F);
  data->GetFieldData()->AddArray(time);
  data->GetPoints()->GetData()->GetRange();
  // A range that was asked for is stored as information of the array and written as METADATA.
  double range[2];
  data->GetPoints()->GetData()->GetRange(range, -1);

  const TemporaryFile written;
  const auto write = [&](auto* writer) {
    writer->SetFileName(written.path().c_str());
    writer->SetFileVersion(version);
    writer->SetInputData(data);
    if (binary) {
      writer->SetFileTypeToBinary();
    }
    REQUIRE(writer->Write() == 1);
  };
  if (poly_data) {
    write(vtkNew<vtkPolyDataWriter>().Get());
  } else {
    write(vtkNew<vtkUnstructuredGridWriter>().Get());
  }
  CHECK(written.bytes().find("METADATA") != std::string::npos);
  const MeshDocument document = read_mesh(written.path());
  CHECK(find_array(document.point_arrays, "100% \"named\" array") != nullptr);
  // VTK's own reader stands between: its writer rounds in ASCII.
  check_same(document, read_with_vtk(written.path()));
}

TEST_CASE("legacy VTK: the cells of a POLYDATA come in VTK's order") {
  const bool binary = GENERATE(false, true);
  const bool with_offsets = GENERATE(false, true);
  const MeshDocument document = read_bytes(poly_data_file(binary, with_offsets).bytes());
  CHECK(document.cells.types == std::vector<std::uint8_t>{1, 2, 3, 4, 5, 9, 7, 6});
  CHECK(document.cells.offsets == std::vector<std::int64_t>{0, 1, 3, 5, 8, 11, 15, 20, 24});
  CHECK(document.cells.connectivity ==
        std::vector<std::int32_t>{8, 2, 5, 0, 1, 0, 3, 6, 0, 1, 4, 1, 2, 5, 4, 4, 5, 8, 7, 3, 3, 4, 6, 7});
}

TEST_CASE("legacy VTK: ASCII is a stream of tokens with any white space and line ends") {
  const std::string plain = grid_file(false, false)
                                .text(
                                    "CELL_DATA 7\nSCALARS region int 1\nLOOKUP_TABLE default\n"
                                    "1\n2\n3\n4\n5\n6\n7\n")
                                .bytes();
  const MeshDocument expected = read_bytes(plain);
  std::string one_each = plain;
  const std::size_t header = plain.find("DATASET");
  std::replace(one_each.begin() + static_cast<std::ptrdiff_t>(header), one_each.end(), ' ', '\n');
  std::string one_line = plain;
  std::replace(one_line.begin() + static_cast<std::ptrdiff_t>(header), one_line.end(), '\n', '\t');
  std::string crlf;
  for (const char c : plain) {
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  }
  std::string lower = plain;
  std::transform(lower.begin() + 22, lower.end(), lower.begin() + 22,
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  for (const std::string& variant : {one_each, one_line, crlf, lower}) {
    const MeshDocument document = read_bytes(variant);
    CHECK(document.points == expected.points);
    CHECK(document.cells.connectivity == expected.cells.connectivity);
    CHECK(document.cells.types == expected.cells.types);
    REQUIRE(document.cell_arrays.size() == 1);
    CHECK(document.cell_arrays[0].value(6) == 7);
  }
}

TEST_CASE("legacy VTK: header lines before binary data may end in CR LF") {
  std::string bytes = grid_file(true, false).bytes();
  for (const std::string line : {"POINTS 9 double", "CELLS 7 30", "CELL_TYPES 7"}) {
    const std::size_t at = bytes.find(line);
    REQUIRE(at != std::string::npos);
    bytes.insert(at + line.size(), " \r");
  }
  CHECK(read_bytes(bytes).points == grid_points());
}

TEST_CASE("legacy VTK: the line end behind binary data may be missing") {
  std::string bytes = grid_file(true, false).text("CELL_DATA 7\nSCALARS s char\nLOOKUP_TABLE default\n1234567").bytes();
  for (const std::string keyword : {"CELLS", "CELL_TYPES", "CELL_DATA"}) {
    const std::size_t at = bytes.find("\n" + keyword);
    bytes.erase(at, 1);
  }
  const MeshDocument document = read_bytes(bytes);
  CHECK(document.points == grid_points());
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].value(2) == '3');
}

TEST_CASE("legacy VTK: coordinates of type float are float32 values") {
  const bool binary = GENERATE(false, true);
  const MeshDocument document = read_bytes(grid_file(binary, false, true).bytes());
  CHECK(document.point_type == ScalarType::float32);
  CHECK(document.points[4] == static_cast<double>(0.1F));
  CHECK(read_bytes(grid_file(binary, false).bytes()).point_type == ScalarType::float64);
}

TEST_CASE("legacy VTK: NaN and infinities stay in arrays and end nothing") {
  const std::string file = grid_file(false, false)
                               .text(
                                   "CELL_DATA 7\nSCALARS s float\nLOOKUP_TABLE default\n"
                                   "nan -nan inf -inf NaN INF 1\n"
                                   "VECTORS v double\n")
                               .bytes() +
                           "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 8\n";
  const MeshDocument document = read_bytes(file);
  REQUIRE(document.cell_arrays.size() == 2);
  CHECK(std::isnan(document.cell_arrays[0].value(1)));
  CHECK(document.cell_arrays[0].value(3) == -std::numeric_limits<double>::infinity());
  CHECK(document.cell_arrays[0].value(6) == 1);
  CHECK(document.cell_arrays[1].value(6, 2) == 8);
}

TEST_CASE("legacy VTK: integers have the width that their type says") {
  const auto array_of = [](const std::string& type, const std::string& value) {
    return "FIELD f 1\na 1 1 " + type + "\n" + value + "\n";
  };
  const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n";
  const std::string tail = "POINTS 1 float\n0 0 0\nVERTICES 1 2\n1 0\n";
  const MeshDocument largest = read_bytes(head + array_of("unsigned_long", "18446744073709551615") + tail);
  CHECK(largest.field_arrays[0].as<std::uint64_t>()[0] == std::numeric_limits<std::uint64_t>::max());
  const std::pair<std::string, std::string> wrong[] = {{"char", "128"},
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
  const Fault faults[] = {
      {"# vtk DataFile", "# vtk Datafile_", ":1: expected '# vtk DataFile Version'"},
      {"3.0", "9.9", ":1: file version '9.9' is not supported"},
      {"ASCII", "ASCIZ", ":3: expected ASCII or BINARY, got 'ASCIZ'"},
      {"UNSTRUCTURED_GRID", "STRUCTURED_GRID", ":4: dataset type STRUCTURED_GRID is not supported"},
      {"POINTS 9 double", "POINTS 8 double", ":6: unknown keyword"},
      {"POINTS 9 double", "POINTS 10 double", ":7: expected a coordinate (a number), got 'CELLS'"},
      {"POINTS 9 double", "POINTS 9 int", ":5: coordinates must be float or double"},
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
      {"LOOKUP_TABLE default", "", ":14: expected LOOKUP_TABLE, got '1'"},
      {"7 8 9\n", "7 8\n", ":15: expected values of point array 's', got the end of the file"},
      {"7 8 9\n", "7 8 9 10\n", ":14: unknown keyword '10'"},
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
  bad[cells + 4 * 5 - 1] = 9;  // a vertex of the second cell
  CHECK(error_of(bad) ==
        ": at byte " + std::to_string(cells + 4 * 4) + ": cell 1 of CELLS has vertex 9, but the file has 9 points");
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

TEST_CASE("legacy VTK: a file that ends anywhere is read with all points and cells or refused") {
  const bool binary = GENERATE(false, true);
  const bool with_offsets = GENERATE(false, true);
  Builder file = grid_file(binary, with_offsets);
  file.text("POINT_DATA 9\n");
  add_attributes(file, 9, binary, "p_");
  std::size_t refused = 0;
  for (std::size_t size = 0; size < file.bytes().size(); ++size) {
    try {
      trismooth::VtkLegacyLayout layout;
      const MeshDocument document = trismooth::read_vtk_legacy("cut.vtk", file.bytes().substr(0, size), layout);
      REQUIRE(document.point_count() == 9);
      REQUIRE(document.cells.size() == 7);
      REQUIRE(document.cells.offsets.size() == 8);
      for (const trismooth::DataArray& array : document.point_arrays) {
        REQUIRE(array.rows() == 9);
      }
    } catch (const ReadError&) {
      ++refused;
    }
  }
  CHECK(refused > grid_file(binary, with_offsets).bytes().size() - 3);
}

TEST_CASE("legacy VTK: a byte changed anywhere never does more than cause an error") {
  const bool binary = GENERATE(false, true);
  const bool with_offsets = GENERATE(false, true);
  Builder file = grid_file(binary, with_offsets);
  file.text("CELL_DATA 7\n");
  add_attributes(file, 7, binary, "c_");
  for (std::size_t at = 0; at < file.bytes().size(); ++at) {
    for (const char value : {'\0', '9', '\n', '\xff'}) {
      std::string bytes = file.bytes();
      bytes[at] = value;
      try {
        trismooth::VtkLegacyLayout layout;
        const MeshDocument document = trismooth::read_vtk_legacy("changed.vtk", bytes, layout);
        REQUIRE(document.cells.offsets.size() == document.cells.size() + 1);
        for (const std::int32_t vertex : document.cells.connectivity) {
          REQUIRE(static_cast<std::size_t>(vertex) < document.point_count());
        }
        for (const double coordinate : document.points) {
          REQUIRE(std::isfinite(coordinate));
        }
      } catch (const ReadError&) {
      }
    }
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_reader.h"

#include <cmath>

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGridWriter.h>

#include "vtk_legacy_files.h"

using namespace legacy_test;
using trismooth::find_array;
using trismooth::MeshDocument;
using trismooth::read_mesh;
using trismooth::ScalarType;

namespace {

MeshDocument read_bytes(const std::string& bytes) {
  return read_mesh(TemporaryFile(bytes, ".vtk").path());
}

constexpr std::size_t attribute_count = 20;

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

TEST_CASE("legacy VTK: arrays of variants are passed over, and a note says so") {
  const TemporaryFile file(
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n"
      "3 0 1 2\nPOINT_DATA 3\nFIELD f 2\ns 1 3 variant\n5 1 5 2 5 3\nu 1 3 int\n7 8 9\n",
      ".vtk");
  const MeshDocument document = read_mesh(file.path());
  CHECK(document.point_arrays.size() == 1);
  CHECK(document.notes ==
        std::vector<std::string>{"point array 's' holds variants: it is kept in this file only, not in other formats"});
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

// SPDX-License-Identifier: BSD-3-Clause
// Reading and writing back: VTK's own writer makes the files, VTK's own reader judges the result.

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "vtk_xml_samples.h"

namespace vtk_xml_test {

using trismooth::MeshDocument;
using trismooth::ScalarType;
using trismooth::VtkXmlCompressor;
using trismooth::VtkXmlEncoding;
using trismooth::VtkXmlKind;
using trismooth::VtkXmlMode;
using namespace vtk_xml_samples;

/// The first tag of the file and the formats and encodings in it: what a reader of the file would see of the encoding.
std::string encoding_text(const std::string& bytes) {
  const std::size_t begin = bytes.find("<VTKFile");
  std::string text = bytes.substr(begin, bytes.find('>', begin) - begin);
  for (const char* word :
       {"format=\"ascii\"", "format=\"binary\"", "format=\"appended\"", "encoding=\"raw\"", "encoding=\"base64\""}) {
    text += bytes.find(word) == std::string::npos ? "" : word;
  }
  return text;
}

MeshDocument read_text(const std::string& extension, const std::string& text) {
  const TemporaryPath file(extension);
  write_bytes(file.path(), text);
  return trismooth::read_mesh(file.path());
}

/// Three points and a triangle, with `more` in the piece and those numbers as x of the points.
std::string small_vtu(const std::string& more = "", const std::string& x = "0 1 0",
                      const std::string& type = "Float64") {
  std::string points;
  std::istringstream words(x);
  for (std::string word, y = "0"; words >> word; y = y == "0" ? "0.5" : "1") {
    points += word + " " + y + " 0 ";
  }
  return R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type=")" +
         type + R"(" NumberOfComponents="3" format="ascii">)" + points + R"(</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
)" + more +
         "</Piece></UnstructuredGrid></VTKFile>\n";
}

TEST_CASE("a VTU or VTP file written back unchanged holds the same in the same encoding") {
  const auto kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  const auto point_type = GENERATE(ScalarType::float32, ScalarType::float64);
  for (const VtkXmlEncoding& encoding : all_encodings()) {
    if (encoding.compressor == VtkXmlCompressor::lzma &&
        (kind == VtkXmlKind::poly_data) != (point_type == ScalarType::float32)) {
      continue;  // takes its time
    }
    CAPTURE(to_string(encoding), kind, point_type);
    const auto special = encoding.mode == VtkXmlMode::ascii ? SpecialValues::none : SpecialValues::all;
    const auto sample = make_sample(kind, point_type, special);
    const TemporaryPath input(extension_of(kind));
    const TemporaryPath output(extension_of(kind));
    write_with_vtk(*sample, input.path(), encoding);

    trismooth::write_mesh(output.path(), trismooth::read_mesh(input.path()));

    CHECK(encoding_text(read_bytes(output.path())) == encoding_text(read_bytes(input.path())));
    CHECK(differences(*sample, *read_with_vtk(output.path(), kind)) == "");
  }
}

TEST_CASE("the document states what the file holds") {
  const auto kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  const auto point_type = GENERATE(ScalarType::float32, ScalarType::float64);
  const auto sample = make_sample(kind, point_type, SpecialValues::all);
  const TemporaryPath input(extension_of(kind));
  write_with_vtk(*sample, input.path(), {});
  const MeshDocument document = trismooth::read_mesh(input.path());

  REQUIRE(document.point_type == point_type);
  REQUIRE(document.point_count() == static_cast<std::size_t>(sample->GetNumberOfPoints()));
  for (std::size_t i = 0; i < document.points.size(); ++i) {
    CHECK(document.points[i] ==
          sample->GetPoints()->GetData()->GetComponent(static_cast<vtkIdType>(i / 3), static_cast<int>(i % 3)));
  }
  REQUIRE(document.cells.size() == static_cast<std::size_t>(sample->GetNumberOfCells()));
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    CAPTURE(cell);
    const auto id = static_cast<vtkIdType>(cell);
    const vtkNew<vtkIdList> vertices;
    sample->GetCellPoints(id, vertices);
    CHECK(document.cells.types[cell] == sample->GetCellType(id));
    REQUIRE(document.cells[cell].size() == static_cast<std::size_t>(vertices->GetNumberOfIds()));
    for (std::size_t i = 0; i < document.cells[cell].size(); ++i) {
      CHECK(document.cells[cell][i] == vertices->GetId(static_cast<vtkIdType>(i)));
    }
  }
  // All but the strings and the bits.
  CHECK(document.point_arrays.size() + 2 == static_cast<std::size_t>(sample->GetPointData()->GetNumberOfArrays()));
  CHECK(document.cell_arrays.size() + 2 == static_cast<std::size_t>(sample->GetCellData()->GetNumberOfArrays()));
  CHECK(document.field_arrays.size() + 1 == static_cast<std::size_t>(sample->GetFieldData()->GetNumberOfArrays()));
  CHECK(document.notes.size() == 5);
  for (const trismooth::DataArray& array : document.point_arrays) {
    CAPTURE(array.name);
    vtkDataArray* const expected = sample->GetPointData()->GetArray(array.name.c_str());
    REQUIRE(array.components == static_cast<std::size_t>(expected->GetNumberOfComponents()));
    REQUIRE(array.rows() == document.point_count());
    CHECK(std::memcmp(array.bytes.data(), expected->GetVoidPointer(0), array.bytes.size()) == 0);
  }
}

TEST_CASE("array views outlive the document they came from") {
  trismooth::DataArray array;
  {
    const MeshDocument document = read_text(
        ".vtu",
        small_vtu(R"(<PointData><DataArray type="Int16" Name="a" format="ascii">7 8 9</DataArray></PointData>)"));
    array = document.point_arrays.at(0);
  }
  CHECK(array.value(2) == 9.0);
}

TEST_CASE("moved points and added arrays are written, all else stays") {
  const auto kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  const auto point_type = GENERATE(ScalarType::float32, ScalarType::float64);
  const auto sample = make_sample(kind, point_type, SpecialValues::all);
  const TemporaryPath input(extension_of(kind));
  const TemporaryPath output(extension_of(kind));
  write_with_vtk(*sample, input.path(), {});
  MeshDocument document = trismooth::read_mesh(input.path());
  document.points[15] = 0.375;
  const std::vector<float> shape(document.cells.size(), 0.5F);
  const std::vector<std::uint8_t> fixed(document.point_count(), 1);
  trismooth::write_mesh(output.path(), document,
                        {.point_arrays = {trismooth::make_data_array("fixed", 1, fixed)},
                         .cell_arrays = {trismooth::make_data_array("float32", 1, shape)}});

  const auto result = read_with_vtk(output.path(), kind);
  REQUIRE(result->GetCellData()->GetArray("float32_1") != nullptr);
  CHECK(result->GetCellData()->GetArray("float32_1")->GetTuple1(3) == 0.5);
  REQUIRE(result->GetPointData()->GetArray("fixed") != nullptr);
  CHECK(result->GetPointData()->GetArray("fixed")->GetDataType() == VTK_UNSIGNED_CHAR);
  CHECK(result->GetPoint(5)[0] == 0.375);
  result->GetCellData()->RemoveArray("float32_1");
  result->GetPointData()->RemoveArray("fixed");
  sample->GetPoints()->SetPoint(5, 0.375, sample->GetPoint(5)[1], sample->GetPoint(5)[2]);
  CHECK(differences(*sample, *result) == "");
  // What was read is untouched.
  const TemporaryPath again(extension_of(kind));
  document = trismooth::read_mesh(input.path());
  trismooth::write_mesh(again.path(), document);
  CHECK(trismooth::read_mesh(again.path()).point_arrays.size() == document.point_arrays.size());
}

TEST_CASE("text that VTK's own writer or reader would spoil comes back bit for bit") {
  const MeshDocument document =
      read_text(".vtu", small_vtu("<PointData><DataArray type=\"Float64\" Name=\"a\" format=\"ascii\">-0 nan -inf"
                                  "</DataArray><DataArray type=\"Float32\" Name=\"b\" format=\"ascii\">-0 0.1 1e-45"
                                  "</DataArray></PointData>",
                                  "-0 0.1 0.30000000000000004"));
  CHECK(document.notes.size() == 1);
  const TemporaryPath output(".vtu");
  trismooth::write_mesh(output.path(), document);
  const MeshDocument again = trismooth::read_mesh(output.path());
  CHECK(std::memcmp(again.points.data(), document.points.data(), 72) == 0);
  CHECK(std::signbit(again.points[0]));
  const auto values = again.point_arrays.at(0).as<double>();
  CHECK((values[0] == 0 && std::signbit(values[0])));
  CHECK(std::isnan(values[1]));
  CHECK(values[2] == -std::numeric_limits<double>::infinity());
  const auto floats = again.point_arrays.at(1).as<float>();
  CHECK((floats[0] == 0 && std::signbit(floats[0]) && floats[1] == 0.1F && floats[2] == 1e-45F));
  // VTK reads it too, and the same.
  const auto judged = read_with_vtk(output.path(), VtkXmlKind::unstructured_grid);
  CHECK(std::memcmp(judged->GetPointData()->GetArray("a")->GetVoidPointer(0), values.data(), 24) == 0);
  CHECK(std::memcmp(judged->GetPointData()->GetArray("b")->GetVoidPointer(0), floats.data(), 12) == 0);
}

TEST_CASE("names with markup, quotes and line ends come back") {
  const MeshDocument document = read_text(
      ".vtu", small_vtu("<PointData Scalars=\"a&lt;b&amp;&quot;&#10;\"><DataArray type=\"Int16\" format=\"ascii\" "
                        "Name=\"a&lt;b&amp;&quot;&#10;\" ComponentName0=\"&gt;&lt;\">1 2 3</DataArray></PointData>"));
  REQUIRE(document.point_arrays.at(0).name == "a<b&\"\n");
  const TemporaryPath output(".vtu");
  trismooth::write_mesh(output.path(), document);
  const MeshDocument again = trismooth::read_mesh(output.path());
  CHECK(again.point_arrays.at(0).name == "a<b&\"\n");
  const auto judged = read_with_vtk(output.path(), VtkXmlKind::unstructured_grid);
  REQUIRE(judged->GetPointData()->GetScalars() != nullptr);
  CHECK(std::string(judged->GetPointData()->GetScalars()->GetName()) == "a<b&\"\n");
  CHECK(std::string(judged->GetPointData()->GetScalars()->GetComponentName(0)) == "><");
}

TEST_CASE("two arrays of the same name are both kept") {
  const MeshDocument document = read_text(
      ".vtu", small_vtu("<PointData><DataArray type=\"Int16\" Name=\"a\" format=\"ascii\">1 2 3</DataArray>"
                        "<DataArray type=\"Int32\" Name=\"a\" format=\"ascii\">4 5 6</DataArray></PointData>"));
  const TemporaryPath output(".vtu");
  trismooth::write_mesh(output.path(), document);
  const MeshDocument again = trismooth::read_mesh(output.path());
  REQUIRE(again.point_arrays.size() == 2);
  CHECK((again.point_arrays[0].type == ScalarType::int16 && again.point_arrays[0].value(0) == 1));
  CHECK((again.point_arrays[1].type == ScalarType::int32 && again.point_arrays[1].value(0) == 4));
}

TEST_CASE("pieces are joined as VTK joins them") {
  const std::string piece_begin = R"(<Piece NumberOfPoints="3" NumberOfVerts="1" NumberOfPolys="1">
<PointData><DataArray type="Int32" Name="p" format="ascii">)";
  const std::string piece_middle = R"(</DataArray></PointData>
<CellData><DataArray type="Int32" Name="c" format="ascii">)";
  const std::string piece_end = R"(</DataArray></CellData>
<Points><DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray>
</Points><Verts><DataArray type="Int64" Name="connectivity" format="ascii">2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">1</DataArray></Verts>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys></Piece>)";
  const std::string empty = R"(<Piece NumberOfPoints="0" NumberOfVerts="0" NumberOfPolys="0"></Piece>)";
  const TemporaryPath input(".vtp");
  write_bytes(input.path(), R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>)" +
                                piece_begin + "1 2 3" + piece_middle + "10 20" + piece_end + empty + piece_begin +
                                "4 5 6" + piece_middle + "30 40" + piece_end + "</PolyData></VTKFile>");
  const MeshDocument document = trismooth::read_mesh(input.path());
  REQUIRE(document.losses.size() == 1);
  CHECK(document.losses[0].find("pieces") != std::string::npos);
  CHECK(document.notes ==
        std::vector<std::string>{"the pieces have points of their own in 3 places where they meet: the cuts between "
                                 "them are boundaries, whose vertices are held"});
  CHECK(document.point_count() == 6);
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{2, 5, 0, 1, 2, 3, 4, 5});
  const auto cells = document.cell_arrays.at(0).as<std::int32_t>();
  CHECK(std::vector<std::int32_t>(cells.begin(), cells.end()) == std::vector<std::int32_t>{10, 30, 20, 40});
  const TemporaryPath output(".vtp");
  trismooth::write_mesh(output.path(), document);
  CHECK(trismooth::read_mesh(output.path()).losses.empty());
  CHECK(trismooth::read_mesh(output.path()).cells.connectivity == document.cells.connectivity);
}

TEST_CASE("indices of other types are read, and the change is noted") {
  std::string text = small_vtu();
  text.replace(text.find("Int32\" Name=\"offsets"), 5, "UInt16");
  text.replace(text.find("UInt8"), 5, "Int64");
  const MeshDocument document = read_text(".vtu", text);
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2});
  CHECK(document.losses.size() == 2);
}

TEST_CASE("attributes that VTK cannot hold are noted") {
  const MeshDocument document =
      read_text(".vtu", small_vtu("<PointData Vectors=\"a\" Normals=\"nothing\"><DataArray type=\"Int16\" Name=\"a\" "
                                  "format=\"ascii\">1 2 3</DataArray></PointData><Extra/>"));
  CHECK(document.losses.size() == 3);
}

TEST_CASE("a mesh without points or cells is read and written") {
  const auto kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  const std::string name(trismooth::to_string(kind));
  const MeshDocument document =
      read_text(extension_of(kind), "<VTKFile type=\"" + name + "\"><" + name +
                                        "><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/></" + name + "></VTKFile>");
  CHECK(document.point_count() == 0);
  CHECK(document.cells.size() == 0);
  const TemporaryPath output(extension_of(kind));
  trismooth::write_mesh(output.path(), document);
  CHECK(trismooth::read_mesh(output.path()).point_count() == 0);
}

TEST_CASE("a document from elsewhere becomes a VTU or VTP file") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0.1, 0, 1, 0};
  document.cells.append(5, std::array{0, 1, 2});
  document.cells.append(3, std::array{0, 1});
  document.cells.append(10, std::array{0, 1, 2, 3});
  document.cells.append(9, std::array{0, 1, 2, 3});
  document.cells.append(1, std::array{3});
  document.cell_arrays.push_back(trismooth::make_data_array("region", 1, std::vector<std::int32_t>{1, 2, 3, 4, 5}));
  document.point_arrays.push_back(trismooth::make_data_array("a & b", 2, std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
  document.field_arrays.push_back(trismooth::make_data_array("f", 1, std::vector<double>{0.1}));

  SECTION("VTU holds all of it") {
    CHECK(trismooth::what_is_lost(document, trismooth::FileFormat::vtu).empty());
    const TemporaryPath output(".vtu");
    trismooth::write_mesh(output.path(), document);
    const MeshDocument again = trismooth::read_mesh(output.path());
    CHECK(again.points == document.points);
    CHECK(again.cells.connectivity == document.cells.connectivity);
    CHECK(again.cells.offsets == document.cells.offsets);
    CHECK(again.cells.types == document.cells.types);
    CHECK(again.point_arrays.at(0).name == "a & b");
    CHECK(again.point_arrays.at(0).value(3, 1) == 8);
    CHECK(again.field_arrays.at(0).value(0) == 0.1);
    const auto judged = read_with_vtk(output.path(), VtkXmlKind::unstructured_grid);
    CHECK(judged->GetNumberOfCells() == 5);
    CHECK(judged->GetPoint(2)[2] == 0.1);
    CHECK(judged->GetCellData()->GetArray("region")->GetTuple1(4) == 5);
  }
  SECTION("VTP sorts the cells into its lists and says what it cannot hold") {
    const auto lost = trismooth::what_is_lost(document, trismooth::FileFormat::vtp);
    REQUIRE(lost.size() == 2);
    CHECK(lost[0].find("type 10") != std::string::npos);
    CHECK(lost[1].find("order") != std::string::npos);
    const TemporaryPath output(".vtp");
    trismooth::write_mesh(output.path(), document);
    const auto judged = read_with_vtk(output.path(), VtkXmlKind::poly_data);
    REQUIRE(judged->GetNumberOfCells() == 4);
    const int types[] = {1, 3, 5, 9};
    const double regions[] = {5, 2, 1, 4};
    for (int i = 0; i < 4; ++i) {
      CHECK(judged->GetCellType(i) == types[i]);
      CHECK(judged->GetCellData()->GetArray("region")->GetTuple1(i) == regions[i]);
    }
  }
  SECTION("the point type is kept") {
    document.points[8] = 0.5;
    document.point_type = ScalarType::float32;
    const TemporaryPath output(".vtu");
    trismooth::write_mesh(output.path(), document);
    CHECK(trismooth::read_mesh(output.path()).point_type == ScalarType::float32);
    CHECK(trismooth::read_mesh(output.path()).points == document.points);
  }
}

TEST_CASE("a file that cannot be written is a WriteError that names it") {
  const MeshDocument document = read_text(".vtu", small_vtu());
  SECTION("no such folder") {
    CHECK_THROWS_AS(trismooth::write_mesh("/no/such/folder/a.vtu", document), trismooth::WriteError);
  }
  SECTION("a full disk") {
    if (std::filesystem::exists("/dev/full")) {
      const TemporaryPath link(".vtu");
      std::filesystem::create_symlink("/dev/full", link.path());
      CHECK_THROWS_AS(trismooth::write_mesh(link.path(), document), trismooth::WriteError);
      CHECK(std::filesystem::exists("/dev/full"));
    }
  }
  SECTION("other points than were read") {
    MeshDocument other = document;
    other.points.resize(6);
    const TemporaryPath output(".vtu");
    CHECK_THROWS_AS(trismooth::write_mesh(output.path(), other), trismooth::WriteError);
    CHECK_FALSE(std::filesystem::exists(output.path()));
  }
}

}  // namespace vtk_xml_test

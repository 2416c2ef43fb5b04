// SPDX-License-Identifier: BSD-3-Clause
// What files say of arrays beside names and numbers: names of components, units, active arrays. From each of VTK's
// formats to each other all of it arrives, or what_is_lost() says what does not. VTK's own readers judge.

#include "trismooth/mesh_io/vtk_xml/vtk_array_description.h"

#include <algorithm>
#include <string>
#include <vector>

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>

#include "trismooth/mesh_io/mesh_file.h"

#include "vtk_legacy_files.h"
#include "vtk_xml_samples.h"

using trismooth::FileFormat;
using trismooth::MeshDocument;

namespace described {

const std::string head_of_vtu = R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><FieldData><DataArray type="Float64" Name="when" NumberOfTuples="1" format="ascii">
0.5<InformationKey name="UNITS_LABEL" location="vtkDataArray">s</InformationKey></DataArray></FieldData>
<Piece NumberOfPoints="3" NumberOfCells="1">
)";
const std::string rest_of_vtu =
    R"(<Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0<InformationKey name="UNITS_LABEL" location="vtkDataArray">mm</InformationKey></DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
)";

std::string vtu() {
  return head_of_vtu + R"(<PointData Scalars="b" Vectors="velocity" TCoords="uv">
<DataArray type="Int16" Name="a" format="ascii">1 2 3</DataArray>
<DataArray type="Float32" Name="velocity" NumberOfComponents="3" ComponentName0="radial" ComponentName2="up %"
 format="ascii">1 2 3 4 5 6 7 8 9
<InformationKey name="UNITS_LABEL" location="vtkDataArray">m / s</InformationKey></DataArray>
<DataArray type="Float64" Name="b" format="ascii">4 5 6</DataArray>
<DataArray type="Float64" Name="uv" NumberOfComponents="2" format="ascii">0 0 1 0 0 1</DataArray>
</PointData><CellData Scalars="region"><DataArray type="Int32" Name="other" format="ascii">8</DataArray>
<DataArray type="Int32" Name="region" format="ascii">7</DataArray></CellData>)" +
         rest_of_vtu;
}

std::string vtk(bool binary) {
  legacy_test::Builder file(binary, "3.0", "UNSTRUCTURED_GRID");
  const std::string units = "INFORMATION 1\nNAME UNITS_LABEL LOCATION vtkDataArray\nDATA ";
  file.text("FIELD f 1\nwhen 1 1 double\n").numbers(std::vector{0.5}).text("METADATA\n" + units + "s\n\n");
  file.text("POINTS 3 double\n").numbers(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  file.text("METADATA\n" + units + "mm\n\n");
  file.cells("CELLS", {{0, 1, 2}}, false).text("CELL_TYPES 1\n").numbers(std::vector{5});
  file.text("POINT_DATA 3\nFIELD f 1\na 1 3 short\n").numbers(std::vector<std::int16_t>{1, 2, 3});
  file.text("VECTORS velocity float\n").numbers(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9});
  file.text("METADATA\nCOMPONENT_NAMES\nradial\n\nup%20%25\n" + units + "m%20/%20s\n\n");
  file.text("SCALARS b double\nLOOKUP_TABLE default\n").numbers(std::vector<double>{4, 5, 6});
  file.text("TEXTURE_COORDINATES uv 2 double\n").numbers(std::vector<double>{0, 0, 1, 0, 0, 1});
  file.text("CELL_DATA 1\nFIELD f 1\nother 1 1 int\n").numbers(std::vector{8});
  file.text("SCALARS region int 1\nLOOKUP_TABLE default\n").numbers(std::vector{7});
  // Only the first of a kind is active.
  file.text("SCALARS second int 1\nLOOKUP_TABLE default\n").numbers(std::vector{9});
  return file.bytes();
}

std::string units_of(vtkAbstractArray* array) {
  REQUIRE(array != nullptr);
  const char* const units = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  return units == nullptr ? "" : units;
}

std::string name_of(vtkAbstractArray* array) {
  return array == nullptr ? "(none)" : array->GetName();
}

/// What both files above say.
void check_all(vtkPointSet& data) {
  vtkPointData& points = *data.GetPointData();
  CHECK(name_of(points.GetScalars()) == "b");
  CHECK(name_of(points.GetVectors()) == "velocity");
  CHECK(name_of(points.GetTCoords()) == "uv");
  CHECK(points.GetNormals() == nullptr);
  CHECK(name_of(data.GetCellData()->GetScalars()) == "region");
  vtkDataArray* const velocity = points.GetArray("velocity");
  REQUIRE(velocity != nullptr);
  REQUIRE(velocity->HasAComponentName());
  CHECK(std::string(velocity->GetComponentName(0)) == "radial");
  CHECK(std::string(velocity->GetComponentName(1) == nullptr ? "" : velocity->GetComponentName(1)).empty());
  CHECK(std::string(velocity->GetComponentName(2)) == "up %");
  CHECK(units_of(velocity) == "m / s");
  CHECK(units_of(points.GetArray("a")).empty());
  CHECK(units_of(data.GetFieldData()->GetArray("when")) == "s");
  CHECK(units_of(data.GetPoints()->GetData()) == "mm");
  // In their order, whatever is active.
  CHECK(name_of(points.GetAbstractArray(0)) == "a");
  CHECK(name_of(points.GetAbstractArray(1)) == "velocity");
  CHECK(name_of(points.GetAbstractArray(2)) == "b");
}

vtkSmartPointer<vtkPointSet> judged(const std::filesystem::path& path) {
  if (path.extension() == ".vtk") {
    return legacy_test::read_with_vtk(path);
  }
  return vtk_xml_samples::read_with_vtk(
      path, path.extension() == ".vtp" ? trismooth::VtkXmlKind::poly_data : trismooth::VtkXmlKind::unstructured_grid);
}

bool any_says(const std::vector<std::string>& sentences, const std::string& part) {
  return std::ranges::any_of(sentences, [&](const std::string& s) { return s.find(part) != std::string::npos; });
}

}  // namespace described

TEST_CASE("names of components, units and active arrays get from each of VTK's formats to each other") {
  const auto source = GENERATE(0, 1, 2);
  const std::string bytes = source == 0 ? described::vtu() : described::vtk(source == 2);
  const legacy_test::TemporaryFile input(bytes, source == 0 ? ".vtu" : ".vtk");
  described::check_all(*described::judged(input.path()));
  const MeshDocument document = trismooth::read_mesh(input.path());
  CHECK(document.losses.empty());
  for (const auto& [extension, format] :
       {std::pair(".vtk", FileFormat::vtk), std::pair(".vtu", FileFormat::vtu), std::pair(".vtp", FileFormat::vtp)}) {
    CAPTURE(source, extension);
    const legacy_test::TemporaryFile output(extension);
    trismooth::write_mesh(output.path(), document);
    CHECK(trismooth::what_is_lost(document, format).empty());
    described::check_all(*described::judged(output.path()));
    // And on: the way back.
    const MeshDocument again = trismooth::read_mesh(output.path());
    CHECK(again.losses.empty());
    for (const std::string back : {".vtk", ".vtu", ".vtp"}) {
      const legacy_test::TemporaryFile last(back);
      trismooth::write_mesh(last.path(), again);
      described::check_all(*described::judged(last.path()));
    }
  }
}

TEST_CASE("a BINARY legacy file has the same descriptions as one of text") {
  MeshDocument document = trismooth::read_mesh(legacy_test::TemporaryFile(described::vtu(), ".vtu").path());
  document.field_arrays.push_back(
      trismooth::make_data_array("not finite", 1, std::vector<double>{std::numeric_limits<double>::quiet_NaN()}));
  const legacy_test::TemporaryFile output(".vtk");
  trismooth::write_mesh(output.path(), document);
  CHECK(output.bytes().find("BINARY") != std::string::npos);
  described::check_all(*described::judged(output.path()));
}

TEST_CASE("a role or an information that the target has not is said") {
  const std::string ids = described::head_of_vtu + R"(<PointData GlobalIds="id" Tangents="t" Scalars="t">
<DataArray type="Int64" IdType="1" Name="id" format="ascii">10 20 30000000000</DataArray>
<DataArray type="Float32" Name="t" NumberOfComponents="3" format="ascii">1 2 3 4 5 6 7 8 9</DataArray></PointData>)" +
                          described::rest_of_vtu;
  const MeshDocument document = trismooth::read_mesh(legacy_test::TemporaryFile(ids, ".vtu").path());
  SECTION("VTP has them all") {
    const legacy_test::TemporaryFile output(".vtp");
    trismooth::write_mesh(output.path(), document);
    CHECK(trismooth::what_is_lost(document, FileFormat::vtp).empty());
    const auto data = described::judged(output.path());
    CHECK(described::name_of(data->GetPointData()->GetGlobalIds()) == "id");
    CHECK(described::name_of(data->GetPointData()->GetTangents()) == "t");
    CHECK(described::name_of(data->GetPointData()->GetScalars()) == "t");
    CHECK(data->GetPointData()->GetGlobalIds()->GetVariantValue(2).ToLongLong() == 30000000000);
  }
  SECTION("legacy VTK has one a array, and none for wide ids and tangents") {
    const legacy_test::TemporaryFile output(".vtk");
    trismooth::write_mesh(output.path(), document);
    const auto lost = trismooth::what_is_lost(document, FileFormat::vtk);
    CHECK(lost.size() == 2);
    CHECK(described::any_says(lost, "'id' is written, but not as active GlobalIds"));
    CHECK(described::any_says(lost, "'t' is written, but not as active Tangents"));
    const auto data = described::judged(output.path());
    CHECK(described::name_of(data->GetPointData()->GetScalars()) == "t");
    CHECK(data->GetPointData()->GetArray("id")->GetVariantValue(2).ToLongLong() == 30000000000);
  }
}

TEST_CASE("an information that VTK does not know is lost") {
  legacy_test::Builder file = legacy_test::grid_file(false, false);
  file.text("POINT_DATA 9\nGLOBAL_IDS id vtkIdType\n1 2 3 4 5 6 7 8 9\n");
  file.text("METADATA\nINFORMATION 1\nNAME COLOUR LOCATION nobody\nDATA red green\n\n");
  const MeshDocument document = trismooth::read_mesh(legacy_test::TemporaryFile(file.bytes(), ".vtk").path());
  CHECK(document.losses.empty());
  const auto lost = trismooth::what_is_lost(document, FileFormat::vtu);
  CHECK(lost.size() == 1);
  CHECK(described::any_says(lost, "the information nobody::COLOUR of the array id is not kept"));
  CHECK(trismooth::what_is_lost(document, FileFormat::vtk).empty());
  const legacy_test::TemporaryFile output(".vtu");
  trismooth::write_mesh(output.path(), document);
  CHECK(described::judged(output.path())->GetPointData()->GetArray("id")->GetTuple1(8) == 9);
}

TEST_CASE("units of characters that XML has not, or writes in another way, leave files that can be read") {
  const auto units_after = [](const std::string& encoded) {
    legacy_test::Builder file = legacy_test::grid_file(false, false);
    file.text("POINT_DATA 9\nFIELD f 1\nT 1 9 int\n1 2 3 4 5 6 7 8 9\n");
    file.text("METADATA\nINFORMATION 1\nNAME UNITS_LABEL LOCATION vtkDataArray\nDATA " + encoded + "\n\n");
    const legacy_test::TemporaryFile output(".vtu");
    trismooth::write_mesh(output.path(), trismooth::read_mesh(legacy_test::TemporaryFile(file.bytes(), ".vtk").path()));
    const MeshDocument document = trismooth::read_mesh(output.path());
    REQUIRE(document.point_arrays.at(0).description != nullptr);
    return document.point_arrays[0].description->information.at(0).values.at(0);
  };
  CHECK(units_after("100%20%25%20of%20%3Cit%3E%20%26%22") == "100 % of <it> &\"");
  CHECK(units_after("a%01b") == "a?b");
  CHECK(units_after("%B0C") ==
        "\xC2\xB0"
        "C");
  CHECK(units_after("%C2%B0C") ==
        "\xC2\xB0"
        "C");
}

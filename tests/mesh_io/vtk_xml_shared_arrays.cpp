// SPDX-License-Identifier: BSD-3-Clause
// Pieces whose arrays differ: what all have is joined, by name; what one lacks is told and left out, as VTK does it.

#include "trismooth/mesh_io/vtk_xml/vtk_xml_shared_arrays.h"

#include <algorithm>
#include <string>

#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>

#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "vtk_xml_samples.h"

using trismooth::MeshDocument;
using vtk_xml_samples::TemporaryPath;

namespace pieces_apart {

std::string array(const std::string& name, const std::string& type, const std::string& numbers) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + numbers + "</DataArray>\n";
}

std::string piece(const std::string& point_arrays, const std::string& cell_arrays, const std::string& x) {
  return "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<PointData Scalars=\"p\">\n" + point_arrays +
         "</PointData>\n<CellData>\n" + cell_arrays +
         "</CellData>\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" + x + " 0 0 " +
         x + " 1 0 9 1 0</DataArray></Points>\n<Cells>" + array("connectivity", "Int32", "0 1 2") +
         array("offsets", "Int32", "3") + array("types", "UInt8", "5") + "</Cells></Piece>\n";
}

MeshDocument read(const std::string& pieces, const TemporaryPath& path) {
  vtk_xml_samples::write_bytes(path.path(),
                               "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n<UnstructuredGrid>\n" + pieces +
                                   "</UnstructuredGrid></VTKFile>\n");
  return trismooth::read_mesh(path.path());
}

bool says(const MeshDocument& document, const std::string& part) {
  return std::ranges::any_of(document.losses, [&](const std::string& s) { return s.find(part) != std::string::npos; });
}

}  // namespace pieces_apart

TEST_CASE("arrays that are not in every piece are told and left out, the others joined by name") {
  using pieces_apart::array;
  const TemporaryPath input(".vtu");
  const MeshDocument document = pieces_apart::read(
      pieces_apart::piece(
          array("p", "Int32", "1 2 3") + array("only first", "Int8", "1 2 3") + array("q", "Float64", "1 2 3"),
          array("region", "Int32", "1") + array("changing", "Int32", "1"), "0") +
          pieces_apart::piece(
              array("q", "Float64", "4 5 6") + array("p", "Int32", "4 5 6"),
              array("changing", "Float32", "2") + array("region", "Int32", "2") + array("only last", "Int32", "3"),
              "5"),
      input);
  REQUIRE(document.point_arrays.size() == 2);
  CHECK(document.point_arrays[0].name == "p");
  CHECK(document.point_arrays[1].name == "q");
  CHECK(document.point_arrays[0].value(5) == 6);
  CHECK(document.point_arrays[1].value(3) == 4);
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].name == "region");
  CHECK(document.cell_arrays[0].value(1) == 2);
  CHECK(pieces_apart::says(document, "array 'only first' of <PointData> in line 6 is not in every piece"));
  CHECK(pieces_apart::says(document, "array 'only last' of <CellData>"));
  CHECK(pieces_apart::says(document, "array 'changing' of <CellData> in line 11 is not in every piece"));
  CHECK(pieces_apart::says(document, "pieces"));

  const TemporaryPath output(".vtu");
  trismooth::write_mesh(output.path(), document);
  const auto written = vtk_xml_samples::read_with_vtk(output.path(), trismooth::VtkXmlKind::unstructured_grid);
  REQUIRE(written->GetNumberOfPoints() == 6);
  // Not what VTK reads of the pieces: it takes arrays by their place, and these stand in another order in the second.
  for (const char* const name : {"p", "q"}) {
    for (vtkIdType i = 0; i < 6; ++i) {
      CHECK(written->GetPointData()->GetArray(name)->GetTuple1(i) == static_cast<double>(i + 1));
    }
  }
  CHECK(written->GetCellData()->GetArray("region")->GetTuple1(1) == 2);
  CHECK(std::string(written->GetPointData()->GetScalars()->GetName()) == "p");
  CHECK(trismooth::read_mesh(output.path()).losses.empty());
}

TEST_CASE("of arrays of one name, each piece's first belongs to the others' first") {
  using pieces_apart::array;
  const TemporaryPath input(".vtu");
  const MeshDocument document = pieces_apart::read(
      pieces_apart::piece(array("p", "Int32", "1 2 3") + array("p", "Int32", "10 20 30"), "", "0") +
          "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>\n" +
          pieces_apart::piece(
              array("p", "Int32", "4 5 6") + array("p", "Int32", "40 50 60") + array("p", "Int32", "7 8 9"), "", "5"),
      input);
  REQUIRE(document.point_arrays.size() == 2);
  CHECK(document.point_arrays[0].value(3) == 4);
  CHECK(document.point_arrays[1].value(3) == 40);
  CHECK(document.losses.size() == 2);
}

// SPDX-License-Identifier: BSD-3-Clause
// What the tags of a file say beside what VTK reads: <VTKFile> keeps it, of the others it is told.

#include "trismooth/mesh_io/vtk_xml/vtk_xml_attributes.h"

#include <algorithm>
#include <string>

#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "vtk_xml_samples.h"

using trismooth::MeshDocument;
using vtk_xml_samples::TemporaryPath;

namespace tags {

std::string file(const std::string& root, const std::string& piece, const std::string& array,
                 const std::string& cells = "") {
  return "<VTKFile " + root + "><UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"4\"" + piece +
         ">\n<PointData Scalars=\"T\">\n<DataArray type=\"Float64\" Name=\"T\" format=\"ascii\"" + array +
         ">0 1 2 3 4</DataArray>\n<DataArray type=\"Float64\" Name=\"U\" format=\"ascii\"" + array +
         ">0 1 2 3 4</DataArray>\n</PointData><Points>"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 .6 .7 "
         "0</DataArray>"
         "</Points><Cells" +
         cells +
         "><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 4 1 2 4 2 3 4 3 0 4</DataArray>"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray>"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5 5 5</DataArray></Cells>"
         "</Piece></UnstructuredGrid></VTKFile>";
}

MeshDocument read(const std::string& text) {
  const TemporaryPath path(".vtu");
  vtk_xml_samples::write_bytes(path.path(), text);
  return trismooth::read_mesh(path.path());
}

std::string root_of(const std::string& text) {
  const std::size_t begin = text.find("<VTKFile");
  return text.substr(begin, text.find('>', begin) - begin);
}

}  // namespace tags

TEST_CASE("the tag of a VTU or VTP stays: version, byte order, width of sizes, and what nobody knows") {
  for (const std::string root :
       {R"(type="UnstructuredGrid")", R"(type="UnstructuredGrid" version="0.1" byte_order="LittleEndian")",
        R"(version="1.0" type="UnstructuredGrid")", R"(type="UnstructuredGrid" version="2.2" header_type="UInt64")",
        R"(type="UnstructuredGrid" version="2.0" byte_order="BigEndian" compressor="vtkZLibDataCompressor")",
        R"(type="UnstructuredGrid" version="1.0" creator="me &amp; &quot;you&quot;" xmlns:x="y")"}) {
    CAPTURE(root);
    const std::string text = tags::file(root, "", "");
    MeshDocument document = tags::read(text);
    CHECK(document.losses.empty());
    const TemporaryPath output(".vtu");
    for (const double x : {0.6, 0.5}) {
      document.points[12] = x;
      trismooth::write_mesh(output.path(), document);
      CHECK(tags::root_of(vtk_xml_samples::read_bytes(output.path())) == tags::root_of(text));
      CHECK(trismooth::read_mesh(output.path()).points == document.points);
      CHECK(vtk_xml_samples::read_with_vtk(output.path(), trismooth::VtkXmlKind::unstructured_grid)->GetPoint(4)[0] ==
            x);
    }
    const bool has_own = root.find("creator") != std::string::npos;
    REQUIRE(document.notes.size() == (has_own ? 1 : 0));
    if (has_own) {
      CHECK(document.notes[0] == "what <VTKFile> says as 'creator', 'xmlns:x' is kept in this format only");
    }
  }
}

TEST_CASE("numbers in attributes may be padded with blanks, as writers in Fortran leave them") {
  std::string text = tags::file("type=\"UnstructuredGrid\"", "", "", "");
  const MeshDocument plain = tags::read(text);
  text = replace_all(text, "NumberOfPoints=\"5\"", "NumberOfPoints=\"           5\"");
  text = replace_all(text, "NumberOfCells=\"4\"", "NumberOfCells=\" 4 \"");
  text = replace_all(text, "NumberOfComponents=\"3\"", "NumberOfComponents=\"\t3\"");
  const MeshDocument document = tags::read(text);
  CHECK(document.points == plain.points);
  CHECK(document.cells.connectivity == plain.cells.connectivity);
  CHECK(document.point_arrays.size() == plain.point_arrays.size());
}

TEST_CASE("words in attributes may be padded with blanks, and a file that others can read is written") {
  const std::string text = tags::file(R"(type="UnstructuredGrid" version="0.1" byte_order="LittleEndian")", "", "", "");
  std::string padded = text;
  for (const std::string word : {"UnstructuredGrid", "0.1", "LittleEndian", "ascii", "Float64"}) {
    padded = replace_all(padded, "=\"" + word + "\"", "=\"  " + word + "\n\"");
  }
  REQUIRE(padded != text);
  MeshDocument document = tags::read(padded);
  CHECK(document.points == tags::read(text).points);
  const TemporaryPath output(".vtu");
  for (const double x : {document.points[12], 0.55}) {
    document.points[12] = x;
    trismooth::write_mesh(output.path(), document);
    CHECK(trismooth::read_mesh(output.path()).points == document.points);
    CHECK(vtk_xml_samples::read_with_vtk(output.path(), trismooth::VtkXmlKind::unstructured_grid)->GetPoint(4)[0] == x);
  }
}

TEST_CASE("attributes that VTK does not know are told with their lines, once each") {
  const MeshDocument document = tags::read(tags::file(R"(type="UnstructuredGrid" creator="me")", " units=\"mm\"",
                                                      " units=\"K\" RangeMin=\"0\" ComponentName0=\"t\"", " x=\"\""));
  CHECK(document.losses == std::vector<std::string>{"the attribute 'x' of <Cells> in line 5 is not kept",
                                                    "the attribute 'units' of <DataArray> in lines 3 and 4 is not kept",
                                                    "the attribute 'units' of <Piece> in line 1 is not kept"});
  const TemporaryPath output(".vtu");
  trismooth::write_mesh(output.path(), document);
  CHECK(trismooth::read_mesh(output.path()).losses.empty());
}

TEST_CASE("names of components that an array has not are told") {
  const MeshDocument document = tags::read(
      tags::file(R"(type="UnstructuredGrid")", "", " ComponentName0=\"a\" ComponentName1=\"b\" ComponentNames=\"c\""));
  CHECK(document.losses ==
        std::vector<std::string>{"the attribute 'ComponentName1' of <DataArray> in lines 3 and 4 is not kept",
                                 "the attribute 'ComponentNames' of <DataArray> in lines 3 and 4 is not kept"});
}

TEST_CASE("an attribute that stands in many lines is told with the first three") {
  trismooth::XmlElement root;
  root.children.resize(1);
  root.children[0].name = "Points";
  for (std::size_t line = 1; line <= 1000; ++line) {
    auto& array = root.children[0].children.emplace_back();
    array.name = "DataArray";
    array.attributes = {{"type", "Int8"}, {"unit", "m"}};
    array.line = line;
  }
  CHECK(trismooth::unknown_vtk_xml_attributes(root) ==
        std::vector<std::string>{"the attribute 'unit' of <DataArray> in lines 1, 2, 3 and 997 more is not kept"});
}

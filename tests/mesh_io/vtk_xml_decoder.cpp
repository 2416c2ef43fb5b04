// SPDX-License-Identifier: BSD-3-Clause
// Arrays as other programs encode them: the size in front of base64 by itself, more numbers than the counts ask for.
// VTK's reader takes the same files for the same mesh.

#include "trismooth/mesh_io/vtk_xml/vtk_xml_decoder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "vtk_xml_samples.h"

using trismooth::MeshDocument;
using trismooth::VtkXmlKind;
using vtk_xml_samples::TemporaryPath;

namespace encoded_apart {

std::string base64(const std::string& bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? alphabet[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// The size and the numbers, each encoded by itself, as MFEM does it.
template <class Size, class T>
std::string apart(const std::vector<T>& numbers) {
  const std::string bytes = bytes_of(numbers);
  return base64(bytes_of(std::vector{static_cast<Size>(bytes.size())})) + base64(bytes);
}

const std::vector<double> points{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.625, 0.75, 0};

/// Attributes of <VTKFile> and the arrays of a file, in the order in which VTK's writer puts them.
template <class Size>
std::vector<std::string> arrays() {
  return {apart<Size>(std::vector<float>{1, 2, 3, 4, 5}),
          apart<Size>(std::vector<std::int32_t>{7, 7, 8, 8}),
          apart<Size>(points),
          apart<Size>(std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}),
          apart<Size>(std::vector<std::int32_t>{3, 6, 9, 12}),
          apart<Size>(std::vector<std::uint8_t>{5, 5, 5, 5})};
}

std::string file(const std::string& header_type, const std::vector<std::string>& arrays) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\"" + header_type +
         ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">\n<PointData Scalars=\"T\">\n"
         "<DataArray type=\"Float32\" Name=\"T\" format=\"binary\">\n" +
         arrays[0] +
         "\n</DataArray></PointData>\n<CellData Scalars=\"attribute\">\n"
         "<DataArray type=\"Int32\" Name=\"attribute\" format=\"binary\">\n" +
         arrays[1] +
         "\n</DataArray></CellData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"binary\">\n" +
         arrays[2] +
         "\n</DataArray></Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">\n" +
         arrays[3] + "\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"binary\">\n" + arrays[4] +
         "\n</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">\n" + arrays[5] +
         "\n</DataArray></Cells>\n</Piece></UnstructuredGrid></VTKFile>\n";
}

}  // namespace encoded_apart

TEST_CASE("base64 whose sizes are encoded apart is read as VTK reads it and written in the same way") {
  const bool wide = GENERATE(false, true);
  const std::vector<std::string> arrays =
      wide ? encoded_apart::arrays<std::uint64_t>() : encoded_apart::arrays<std::uint32_t>();
  const TemporaryPath input(".vtu");
  vtk_xml_samples::write_bytes(input.path(), encoded_apart::file(wide ? " header_type=\"UInt64\"" : "", arrays));
  MeshDocument document = trismooth::read_mesh(input.path());
  CHECK(document.losses.empty());
  CHECK(document.notes.empty());
  CHECK(document.points == encoded_apart::points);
  const auto theirs = vtk_xml_samples::read_with_vtk(input.path(), VtkXmlKind::unstructured_grid);
  CHECK(theirs->GetPoint(4)[1] == 0.75);

  const TemporaryPath output(".vtu");
  trismooth::write_mesh(output.path(), document);
  const std::string written = vtk_xml_samples::read_bytes(output.path());
  for (const std::string& array : arrays) {
    CHECK(written.find(array) != std::string::npos);
  }
  CHECK(written.find("<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\"" +
                     std::string(wide ? " header_type=\"UInt64\">" : ">")) != std::string::npos);
  CHECK(vtk_xml_samples::differences(
            *theirs, *vtk_xml_samples::read_with_vtk(output.path(), VtkXmlKind::unstructured_grid)) == "");

  document.points[12] = 0.5;
  trismooth::write_mesh(output.path(), document);
  CHECK(trismooth::read_mesh(output.path()).points == document.points);
  CHECK(vtk_xml_samples::read_with_vtk(output.path(), VtkXmlKind::unstructured_grid)->GetPoint(4)[0] == 0.5);
}

TEST_CASE("base64 whose sizes are encoded apart and lie is refused") {
  const std::vector<std::string> good = encoded_apart::arrays<std::uint32_t>();
  const auto message = [&](std::size_t array, const std::string& text) -> std::string {
    std::vector<std::string> arrays = good;
    arrays[array] = text;
    const TemporaryPath input(".vtu");
    vtk_xml_samples::write_bytes(input.path(), encoded_apart::file("", arrays));
    try {
      trismooth::read_mesh(input.path());
    } catch (const trismooth::ReadError& error) {
      return error.what();
    }
    return "read";
  };
  const auto sized = [](std::uint32_t size, const std::string& rest) {
    return encoded_apart::base64(encoded_apart::bytes_of(std::vector{size})) + rest;
  };
  const std::string points = good[2].substr(8);
  CHECK(message(2, sized(120, points)) == "read");
  CHECK(message(2, sized(119, points)).find("expected 120") != std::string::npos);
  CHECK(message(2, sized(0xFFFFFFF0U, points)).find("declares 4294967280 bytes of data, but has") != std::string::npos);
  CHECK(message(2, sized(0, "")).find("declares 0 bytes of data, expected 120") != std::string::npos);
  CHECK(message(2, sized(120, points.substr(0, 100))).find("120 bytes of data, but has") != std::string::npos);
  CHECK(message(2, sized(120, points + "AAAA")).find("more data than it declares") != std::string::npos);
  CHECK(message(2, sized(120, "=" + points)).find("not base64") != std::string::npos);
}

TEST_CASE("numbers behind those that are asked for are dropped with a note, as VTK drops them") {
  for (const std::string& x : {std::string(" 9 9"), std::string("\n1")}) {
    const std::string file =
        R"(<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Int16" Name="a" format="ascii">4 5 6)" +
        x + R"(</DataArray></PointData><Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0)" +
        x + R"(</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2)" + x +
        R"(</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)";
    const TemporaryPath input(".vtu");
    vtk_xml_samples::write_bytes(input.path(), file);
    const MeshDocument document = trismooth::read_mesh(input.path());
    REQUIRE(document.losses.size() == 3);
    CHECK(std::ranges::count(document.losses,
                             "the array 'a' in line 2 holds more than the 3 numbers that the file asks "
                             "for; the rest is not kept") == 1);
    CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2});
    const auto theirs = vtk_xml_samples::read_with_vtk(input.path(), VtkXmlKind::unstructured_grid);
    REQUIRE(theirs->GetNumberOfPoints() == 3);
    CHECK(theirs->GetPointData()->GetArray("a")->GetNumberOfTuples() == 3);
    const TemporaryPath output(".vtu");
    trismooth::write_mesh(output.path(), document);
    CHECK(trismooth::read_mesh(output.path()).losses.empty());
    CHECK(vtk_xml_samples::differences(
              *theirs, *vtk_xml_samples::read_with_vtk(output.path(), VtkXmlKind::unstructured_grid)) == "");
  }
}

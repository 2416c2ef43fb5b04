// SPDX-License-Identifier: BSD-3-Clause
// Malformed VTU and VTP files: each is refused with a message or read consistently; none crashes, and nothing of VTK
// reaches standard error.

#include <string>
#include <utility>
#include <vector>

#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"
#include "support/readings.h"
#include "support/sanitized.h"
#include "vtk_xml_samples.h"

namespace vtk_xml_malformed_test {

using byte_files::is_valid;
using trismooth::MeshDocument;
using trismooth::ReadError;
using trismooth::VtkXmlCompressor;
using trismooth::VtkXmlEncoding;
using trismooth::VtkXmlKind;
using trismooth::VtkXmlMode;
using namespace vtk_xml_samples;

/// Keeps the first thing that VTK would print.
class KeepingWindow : public vtkOutputWindow {
 public:
  static KeepingWindow* New() {
    auto* const window = new KeepingWindow;
    window->InitializeObjectBase();
    return window;
  }
  void DisplayText(const char* text) override { first = first.empty() ? text : first; }
  std::string first;
};

class Silence {
 public:
  Silence() { vtkOutputWindow::SetInstance(window_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() { vtkOutputWindow::SetInstance(nullptr); }
  std::string broken_by() const { return window_->first; }

 private:
  vtkSmartPointer<KeepingWindow> window_ = vtkSmartPointer<KeepingWindow>::New();
};

MeshDocument read(VtkXmlKind kind, const std::string& bytes) {
  return kind == VtkXmlKind::unstructured_grid ? trismooth::vtu_codec.read("a.vtu", bytes)
                                               : trismooth::vtp_codec.read("a.vtp", bytes);
}

std::vector<VtkXmlEncoding> some_encodings() {
  return {{VtkXmlMode::ascii, true, VtkXmlCompressor::none, false, true},
          {VtkXmlMode::binary, true, VtkXmlCompressor::none, false, false},
          {VtkXmlMode::binary, true, VtkXmlCompressor::zlib, true, true},
          {VtkXmlMode::appended, true, VtkXmlCompressor::none, false, true},
          {VtkXmlMode::appended, true, VtkXmlCompressor::lz4, false, false},
          {VtkXmlMode::appended, false, VtkXmlCompressor::none, true, false},
          {VtkXmlMode::appended, false, VtkXmlCompressor::zlib, false, true},
          {VtkXmlMode::appended, false, VtkXmlCompressor::lz4, false, true},
          {VtkXmlMode::appended, false, VtkXmlCompressor::lzma, false, true}};
}

std::string file_of(VtkXmlKind kind, const VtkXmlEncoding& encoding) {
  const TemporaryPath file(extension_of(kind));
  write_with_vtk(*make_grid(kind, 3), file.path(), encoding);
  return read_bytes(file.path());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// NOLINTNEXTLINE(bugprone-throwing-static-initialization): a test without memory is none
const std::string good_vtu = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Int16" Name="a" format="ascii">
1 2
3</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)";

// NOLINTNEXTLINE(bugprone-throwing-static-initialization): likewise
const std::string good_raw = std::string(R"(<VTKFile type="UnstructuredGrid" version="1.0" header_type="UInt32">
<UnstructuredGrid><Piece NumberOfPoints="1" NumberOfCells="0">
<PointData><DataArray type="UInt8" Name="a" format="appended" offset="0"/></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="appended" offset="5"/></Points>
</Piece></UnstructuredGrid>
<AppendedData encoding="raw">_)") +
                             std::string("\x01\0\0\0\x07\x0C\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 21) +
                             "</AppendedData></VTKFile>";

std::string message_of(VtkXmlKind kind, const std::string& bytes) {
  try {
    read(kind, bytes);
  } catch (const ReadError& error) {
    return error.what();
  }
  return "read without an error";
}

TEST_CASE("malformed elements are refused with the place and the reason") {
  const Silence silence;
  REQUIRE(is_valid(read(VtkXmlKind::unstructured_grid, good_vtu)));
  struct Case {
    std::string from, to, message;
  };
  const Case cases[] = {
      {"\"UnstructuredGrid\"", "\"ImageData\"", "a.vtu:2: expected a VTKFile of type UnstructuredGrid"},
      {"version=\"0.1\"", "version=\"3.0\"", "a.vtu:2: file version '3.0'"},
      {"LittleEndian", "MiddleEndian", "a.vtu:2: <VTKFile> has byte_order 'MiddleEndian'"},
      {"byte_order", "compressor=\"vtkFooDataCompressor\" byte_order", "has compressor 'vtkFooDataCompressor'"},
      {"byte_order", "header_type=\"UInt16\" byte_order", "has header_type 'UInt16'"},
      {"<?xml version=\"1.0\"?>", "<!DOCTYPE a>", "document type declarations"},
      {"</Piece>", "", "a.vtu:12: is not well-formed XML"},
      {"NumberOfPoints=\"3\" ", "", "a.vtu:4: <Piece> has no NumberOfPoints"},
      {"NumberOfPoints=\"3\"", "NumberOfPoints=\"-3\"", "expected a whole number as NumberOfPoints, got '-3'"},
      {"NumberOfPoints=\"3\"", "NumberOfPoints=\"4294967299\"", "a.vtu:4: NumberOfPoints is 4294967299"},
      {"NumberOfPoints=\"3\"", "NumberOfPoints=\"18446744073709551619\"", "expected a whole number"},
      {"NumberOfPoints=\"3\"", "NumberOfPoints=\"2000000000\"", "has room for"},
      {"NumberOfCells=\"1\"", "NumberOfCells=\"2000000000\"", "array 'offsets' should hold 2000000000 numbers"},
      {"NumberOfPoints=\"3\"", "NumberOfPoints=\"2\"", "has the point index 2; there are 2 points"},
      {">3<", ">3 3<", "a.vtu:10: array 'offsets' holds more than the 1 numbers"},
      {">5<", ">5 5<", "a.vtu:11: array 'types' holds more than the 1 numbers"},
      {"NumberOfCells=\"1\"", "NumberOfCells=\"2\"", "array 'offsets' should hold 2 numbers, but has room for 1"},
      {"Int16", "Int17", "a.vtu:5: array 'a' has type 'Int17'"},
      {"Int16", "Int8\" NumberOfComponents=\"0", "array 'a' has 0 components"},
      {"Int16", "Int8\" NumberOfComponents=\"99999999999", "array 'a' has 99999999999 components"},
      {"Int16", "Int8\" TimeStep=\"0", "holds time steps"},
      {" Name=\"a\"", "", "an array of <PointData> has no Name"},
      {"format=\"ascii\">\n1", "format=\"hex\">\n1", "has format 'hex'"},
      {"1 2\n3", "1 2\n3.5", "a.vtu:7: array 'a' expected a number of its type, got '3.5'"},
      {"1 2\n3", "1 2\n40000", "a.vtu:7: array 'a' expected a number of its type, got '40000'"},
      {"1 2\n3", "1 2\n3 x", "a.vtu:7: array 'a' expected a number of its type, got 'x'"},
      {"1 2\n3", "1 2\n+-3", "a.vtu:7: array 'a' expected a number of its type, got '+-3'"},
      {"1 2\n3", "1 2", "a.vtu:5: array 'a' holds 2 numbers, expected 3"},
      {"\"Float64\"", "\"Bit\"", "expected points as 3 components of a type of number"},
      {"\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0",
       "\"Int64\" NumberOfComponents=\"3\" format=\"ascii\">9007199254740993",
       "a.vtu:8: point 0 has the coordinate 9007199254740993, which double precision does not hold"},
      {"NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"", "expected points as 3 components"},
      {"<Points>", "<Points><DataArray type=\"Int8\"/>", "expected one array in <Points>, got 2"},
      {"0 0 0 1", "0 nan 0 1", "point 0 is not finite"},
      {"0 0 0 1", "0 1e999 0 1", "got '1e999'"},
      {">0 1 2<", ">0 1 3<", "a.vtu:9: a cell of <Cells> has the point index 3; there are 3 points"},
      {">0 1 2<", ">0 1 -1<", "point index -1"},
      {">0 1 2<", ">0 1 4294967296<", "got '4294967296'"},
      {">0 1 2<", ">0 1<", "array 'connectivity' should hold 3 numbers, but has room for 2"},
      {">3<", ">2000000000<", "array 'connectivity' should hold 2000000000 numbers"},
      {">3<", ">-3<", "fall from 0 to -3"},
      {"\"Int32\" Name=\"offsets\"", "\"Float32\" Name=\"offsets\"", "'offsets' does not hold one whole number a row"},
      {"Name=\"offsets\"", "Name=\"offset\"", "<Cells> has no array 'offsets'"},
      {"Name=\"types\"", "Name=\"type\"", "<Cells> has no array 'types'"},
      {">5<", ">9<", "cell 0 of type 9 has 3 vertices"},
      {">5<", ">42<", "cell 0 has type 42"},
      {">5<", ">256<", "got '256'"},
  };
  for (const Case& each : cases) {
    CAPTURE(each.from, each.to);
    const std::string message = message_of(VtkXmlKind::unstructured_grid, replaced(good_vtu, each.from, each.to));
    CAPTURE(message);
    CHECK(message.find(each.message) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(message_of(VtkXmlKind::poly_data, good_vtu).find("expected a VTKFile of type PolyData") != std::string::npos);
  // Cells of the other kind would be lost, and the mesh written without them.
  std::string as_polygons = good_vtu;
  for (std::size_t at = 0; (at = as_polygons.find("UnstructuredGrid", at)) != std::string::npos;) {
    as_polygons.replace(at, std::string("UnstructuredGrid").size(), "PolyData");
  }
  CHECK(message_of(VtkXmlKind::poly_data, as_polygons).find("<Cells> is of files of type UnstructuredGrid") !=
        std::string::npos);
  CHECK(message_of(VtkXmlKind::unstructured_grid, replaced(good_vtu, "<Cells>", "<Polys/><Cells>"))
            .find("<Polys> is of files of type PolyData") != std::string::npos);
  CHECK(silence.broken_by() == "");
}

TEST_CASE("block headers that lie are refused before memory is taken") {
  const Silence silence;
  REQUIRE(is_valid(read(VtkXmlKind::unstructured_grid, good_raw)));
  using namespace std::string_literals;
  const std::pair<std::string, std::pair<std::string, std::string>> cases[] = {
      {"\x01\0\0\0\x07"s, {"\xFF\xFF\xFF\xFF\x07"s, "declares 4294967295 bytes of data, but has 17 at most"}},
      {"\x0C\0\0\0"s, {"\x0D\0\0\0"s, "declares 13 bytes of data, which is not a multiple of 4"}},
      {"offset=\"5\"", {"offset=\"999\"", "has offset '999'; the appended data have 21 bytes"}},
      {"offset=\"5\"", {"offset=\"-5\"", "has offset '-5'"}},
      {"offset=\"5\"", {"offset=\"18\"", "ends within its block header"}},
      {"offset=\"5\"", {"", "has offset (none)"}},
      {"offset=\"0\"", {"offset=\"21\"", "ends within its block header"}},
      {">_", {">", "does not start with '_'"}},
      {"</AppendedData>", {"", "the file is cut off"}},
      {"NumberOfPoints=\"1\"", {"NumberOfPoints=\"2147483647\"", "declares 12 bytes of data, expected 25769803764"}},
  };
  for (const auto& [from, change] : cases) {
    const std::string message = message_of(VtkXmlKind::unstructured_grid, replaced(good_raw, from, change.first));
    CAPTURE(from, change.first, message);
    CHECK(message.find(change.second) != std::string::npos);
  }
  CHECK(silence.broken_by() == "");
}

TEST_CASE("XML that is damaged behind the appended data is refused with its line") {
  const std::pair<std::string, std::string> cases[] = {
      {"</AppendedData>", "it is cut off"},
      {"</AppendedData></VTKFile", "it is cut off"},
      {"</AppendedData></VTKFile><a/>", "is not well-formed XML"},
      {"</AppendedData>\n</VTKFil>", "a.vtu:7: is not well-formed XML"},
      {"</AppendedData x></VTKFile>", "is not well-formed XML"},
      {"</AppendedData><!-- ></VTKFile>", "it is cut off"},
      {"</AppendedData>\n\n<UnstructuredGrid/></VTKFile>", "a.vtu:8: <UnstructuredGrid> stands behind <AppendedData>"},
  };
  const std::string end = "</AppendedData></VTKFile>";
  for (const auto& [tail, expected] : cases) {
    const std::string message = message_of(VtkXmlKind::unstructured_grid, replaced(good_raw, end, tail));
    CAPTURE(tail, message);
    CHECK(message.find(expected) != std::string::npos);
  }
  const std::string fine = " </AppendedData\n>\n<!-- the end -->\n</VTKFile> <?x y?>\n";
  CHECK(is_valid(read(VtkXmlKind::unstructured_grid, replaced(good_raw, end, fine))));
}

TEST_CASE("arrays that share their appended data are refused") {
  // Else a small file could make the reader fill the memory.
  const std::string again = R"(<DataArray type="UInt8" Name="b" format="appended" offset="0"/></PointData>)";
  CHECK(message_of(VtkXmlKind::unstructured_grid, replaced(good_raw, "</PointData>", again)).find("overlaps") !=
        std::string::npos);
}

TEST_CASE("VTU and VTP give the same document in parts of any size, and the same errors when they are damaged") {
  using test_support::reading_of;
  using trismooth::FileWorkers;
  const Silence silence;
  const VtkXmlKind kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  const trismooth::Codec& codec = kind == VtkXmlKind::unstructured_grid ? trismooth::vtu_codec : trismooth::vtp_codec;
  trismooth::Workers alone(1);
  trismooth::Workers two(2);
  for (const VtkXmlEncoding& encoding : some_encodings()) {
    INFO(to_string(encoding));
    const std::string bytes = file_of(kind, encoding);
    const std::string expected = reading_of(codec, bytes, FileWorkers(alone, FileWorkers::serial));
    CHECK(expected.find("error") == std::string::npos);
    for (const std::size_t part_bytes : {1UL, 2UL, 3UL, 5UL, 8UL, 20UL, 33UL, 64UL, 100UL, FileWorkers::whole}) {
      INFO(part_bytes);
      CHECK(reading_of(codec, bytes, FileWorkers(alone, part_bytes)) == expected);
      CHECK(reading_of(codec, bytes, FileWorkers(two, part_bytes)) == expected);
    }
    std::uint64_t state = 1;
    const auto below = [&state](std::size_t limit) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      return static_cast<std::size_t>(state >> 33) % limit;
    };
    for (int round = 0; round < (is_sanitized ? 20 : 200); ++round) {
      std::string damaged = bytes;
      damaged[below(damaged.size())] = static_cast<char>(below(256));
      const std::string serial = reading_of(codec, damaged, FileWorkers(alone, FileWorkers::serial));
      for (const std::size_t part_bytes : {1 + below(8), 1 + below(200), FileWorkers::whole}) {
        REQUIRE(reading_of(codec, damaged, FileWorkers(alone, part_bytes)) == serial);
      }
    }
  }
}

TEST_CASE("VTU and VTP are written in the same bytes by any number of threads") {
  const Silence silence;
  const VtkXmlKind kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  for (const VtkXmlEncoding& encoding : some_encodings()) {
    if (encoding.compressor == VtkXmlCompressor::lzma && (is_sanitized || kind == VtkXmlKind::poly_data)) {
      continue;  // takes its time
    }
    INFO(to_string(encoding));
    const TemporaryPath file(extension_of(kind));
    write_with_vtk(*make_grid(kind, 80), file.path(), encoding);  // two blocks and more of 32 KiB
    MeshDocument document = trismooth::read_mesh(file.path());
    document.points[0] += 0.125;
    const TemporaryPath by_one(extension_of(kind));
    const TemporaryPath by_three(extension_of(kind));
    trismooth::write_mesh(by_one.path(), document, {}, 1);
    trismooth::write_mesh(by_three.path(), document, {}, 3);
    CHECK(read_bytes(by_one.path()) == read_bytes(by_three.path()));
    CHECK(trismooth::read_mesh(by_three.path(), 3).points == document.points);
  }
}

}  // namespace vtk_xml_malformed_test

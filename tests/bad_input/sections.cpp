// SPDX-License-Identifier: BSD-3-Clause
// Parts of files that are missing, doubled, of another type or in another order: refused with the place and the reason,
// or read with a note that says what is not kept. What is silently dropped would be lost. More of these stand in the
// tests of each format.
#include <algorithm>
#include <string_view>
#include <vector>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"

using accepted_files::AcceptedFile;

namespace {

const AcceptedFile& file_named(std::string_view name) {
  const auto& files = accepted_files::all();
  const auto found = std::ranges::find(files, name, &AcceptedFile::name);
  REQUIRE(found != files.end());
  return *found;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  INFO(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The first element of that name, from its start tag to its end tag.
std::string element(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find("<" + name);
  const std::string end = "</" + name + ">";
  REQUIRE(begin != std::string::npos);
  return text.substr(begin, text.find(end, begin) + end.size() - begin);
}

void check_refused(const AcceptedFile& file, const std::string& bytes, std::string_view message) {
  const Outcome outcome = read(file, bytes);
  INFO(file.name << ": " << outcome.message << "\nexpected: " << message);
  CHECK(outcome.fault == "");
  CHECK_FALSE(outcome.document);
  CHECK(outcome.message.find(message) != std::string::npos);
}

}  // namespace

TEST_CASE("A section of a VTU or VTP that stands there twice is refused: one of them would be lost") {
  for (const std::string name : {"vtu_ascii_little32", "vtp_ascii_little32", "vtu_appended_raw_little32"}) {
    const AcceptedFile& file = file_named(name);
    const bool poly_data = file.extension == ".vtp";
    for (const std::string section : {"PointData", "CellData", "FieldData", "Points", poly_data ? "Polys" : "Cells"}) {
      const std::string once = element(file.bytes, section);
      check_refused(file, replaced(file.bytes, once, once + once), "a second <" + section + ">");
    }
    const std::string data_set = poly_data ? "PolyData" : "UnstructuredGrid";
    const std::string once = element(file.bytes, data_set);
    check_refused(file, replaced(file.bytes, once, once + once), "a second <" + data_set + ">");
  }
  const AcceptedFile& file = file_named("vtu_ascii_little32");
  const std::string begin = "<DataArray type=\"Int32\" Name=\"offsets\"";
  const std::string from = file.bytes.substr(file.bytes.find(begin));
  const std::string offsets = element(from, "DataArray");
  check_refused(file, replaced(file.bytes, offsets, offsets + offsets), "a second array 'offsets'");
}

TEST_CASE("What a section of a VTU holds beside arrays is named in a note") {
  const AcceptedFile& file = file_named("vtu_ascii_little32");
  for (const std::string section : {"<PointData Scalars=\"depth\">", "<CellData>", "<FieldData>", "<Points>", "<Cells>",
                                    "<UnstructuredGrid>", "<Piece NumberOfPoints=\"9\" NumberOfCells=\"7\">"}) {
    const Outcome outcome = read(file, replaced(file.bytes, section, section + "<dataArray/>"));
    INFO(section << outcome.message);
    REQUIRE(outcome.document);
    CHECK(std::ranges::count_if(outcome.document->losses, [](const std::string& loss) {
            return loss.find("<dataArray>") != std::string::npos;
          }) == 1);
  }
}

TEST_CASE("Data in a VTU or VTP for which it declares no rows are refused") {
  for (const std::string name : {"vtp_ascii_little32", "vtp_inline_zlib_little64", "vtp_appended_raw_zlib_little32",
                                 "vtp_inline_big32", "vtp_appended_raw_big64"}) {
    const AcceptedFile& file = file_named(name);
    const std::string without_data = replaced(file.bytes, element(file.bytes, "CellData"), "");
    for (const std::string count : {"NumberOfLines=\"1\"", "NumberOfPolys=\"6\""}) {
      const std::string zero = count.substr(0, count.size() - 2) + "0\"";
      check_refused(file, replaced(without_data, count, zero),
                    "'connectivity' holds data, but the file declares no rows");
      check_refused(file, replaced(without_data, count, ""),
                    "'connectivity' holds data, but the file declares no rows");
    }
  }
  // More base64 behind a length of nothing.
  const AcceptedFile& encoded = file_named("vtp_inline_big32");
  const std::string hidden =
      "<Strips><DataArray type=\"Int64\" Name=\"connectivity\" format=\"binary\">AAAAAA==AAAAAA==</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"binary\">AAAAAA==</DataArray></Strips></Piece>";
  check_refused(encoded, replaced(encoded.bytes, "</Piece>", hidden),
                "'connectivity' holds data, but the file declares no rows");
  CHECK(read(encoded, replaced(encoded.bytes, "</Piece>", replaced(hidden, "AAAAAA==AAAAAA==", "AAAAAA=="))).document);
  // An array without rows at the place of another one is no loss.
  const AcceptedFile& raw = file_named("vtp_appended_raw_big64");
  const std::string empty =
      "<Strips><DataArray type=\"Int64\" Name=\"connectivity\" format=\"appended\" offset=\"0\"/>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"appended\" offset=\"0\"/></Strips></Piece>";
  const Outcome outcome = read(raw, replaced(raw.bytes, "</Piece>", empty));
  INFO(outcome.message);
  CHECK(outcome.document);
}

TEST_CASE("Rows in a PLY that its header does not declare are refused, white space is not") {
  const AcceptedFile& text = file_named("ply_ascii_double");
  check_refused(text, text.bytes + "3 0 1 2\n", "expected the end of the file after the rows");
  check_refused(text, replaced(text.bytes, "element face 4", "element face 3"), ":18: expected the end of the file");
  CHECK(read(text, text.bytes + " \r\n\n").document);
  CHECK(read(text, text.bytes + "the end\n").document);
  const AcceptedFile& binary = file_named("ply_little_endian_double");
  check_refused(binary, replaced(binary.bytes, "element face 4", "element face 3"),
                "got another row of element 'face'");
  CHECK(read(binary, binary.bytes + std::string("\r\n\0", 3)).document);
}

TEST_CASE("A PLY whose properties are of another type than its data is refused or another mesh of finite numbers") {
  Faults faults;
  for (const AcceptedFile& file : accepted_files::all()) {
    if (file.extension != ".ply") {
      continue;
    }
    constexpr std::string_view types[] = {"char",   "uchar", "short",  "ushort", "int",  "uint", "float",
                                          "double", "int8",  "uint32", "list",   "real", "FLOAT"};
    for (const std::string_view from : {" double", " float", " uchar", " int", " uint16", " uint32", " int8"}) {
      for (std::size_t at = file.bytes.find(from); at < file.bytes.find("end_header");
           at = file.bytes.find(from, at + 1)) {
        for (const std::string_view to : types) {
          std::string bytes = file.bytes;
          bytes.replace(at + 1, from.size() - 1, to);
          faults.add_any(file.name, std::string(from) + " is " + std::string(to), read_and_write(file, bytes).fault);
        }
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("A wrong byte order, compressor or width of block headers is refused wherever it matters") {
  struct Change {
    std::string_view from, to;
  };
  Faults faults;
  std::size_t refused = 0;
  for (const AcceptedFile& file : accepted_files::all()) {
    for (const auto& [from, to] :
         {Change{"LittleEndian", "BigEndian"}, Change{"BigEndian", "LittleEndian"}, Change{"UInt32", "UInt64"},
          Change{"UInt64", "UInt32"}, Change{"vtkZLibData", "vtkLZ4Data"}, Change{"vtkLZ4Data", "vtkLZMAData"},
          Change{"vtkLZMAData", "vtkZLibData"}, Change{"\"raw\"", "\"base64\""}, Change{"\"base64\"", "\"raw\""},
          Change{"binary_little", "binary_big"}, Change{"binary_big", "binary_little"}, Change{"BINARY", "ASCII"},
          Change{"ASCII", "BINARY"}}) {
      const std::size_t at = file.bytes.find(from);
      if (at == std::string::npos) {
        continue;
      }
      const Outcome outcome = read(file, replaced(file.bytes, from, to));
      faults.add_any(file.name, to, outcome.fault);
      const bool matters = !is_vtk_xml(file) || file.name.find("_ascii") == std::string::npos;
      refused += matters ? 1 : 0;
      if (outcome.document.has_value() == matters) {
        faults.add(file.name, to, matters ? "is accepted" : outcome.message);
      }
    }
  }
  CHECK(refused > 60);
  REQUIRE_NONE(faults);
}

TEST_CASE("A file of another format under this extension is refused in one line") {
  Faults faults;
  for (const AcceptedFile& file : accepted_files::all()) {
    for (const trismooth::FileFormat format : trismooth::all_formats()) {
      const std::string extension(extensions_of(format).front());
      const AcceptedFile other{file.name, extension, file.bytes};
      if (format_of(other) == format_of(file)) {
        continue;
      }
      const Outcome outcome = read(other);
      faults.add_any(file.name, extension, outcome.fault);
      if (outcome.document) {
        faults.add(file.name, extension, "is accepted");
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("An array of many components and no rows is refused: VTK would take memory for each component") {
  const AcceptedFile& xml = file_named("vtu_ascii_little32");
  const AcceptedFile& legacy = file_named("legacy_3.0_grid_ascii_rich");
  for (const std::string components : {"100", "101", "1000000"}) {
    const std::string empty_xml =
        "<FieldData><DataArray type=\"Float64\" Name=\"e\" NumberOfTuples=\"0\" "
        "NumberOfComponents=\"" +
        components + "\"/>";
    const std::string with_xml = replaced(xml.bytes, "<FieldData>", empty_xml);
    const std::string with_legacy =
        replaced(legacy.bytes, "FIELD FieldData 1\n", "FIELD FieldData 2\ne " + components + " 0 float\n");
    if (components == "100") {
      CHECK(read(xml, with_xml).document);
      CHECK(read(legacy, with_legacy).document);
    } else {
      check_refused(xml, with_xml, "array 'e' has " + components + " components, but no rows");
      check_refused(legacy, with_legacy, "field array 'e' has " + components + " components, but no rows");
    }
  }
}

TEST_CASE("A file that is cut off is called so") {
  const AcceptedFile& xml = file_named("vtu_ascii_little32");
  check_refused(xml, xml.bytes.substr(0, xml.bytes.find("</Points>")), ":27: ends within <Points>: it is cut off");
  check_refused(xml, "", ":1: ends where XML is expected: it is cut off");
  const AcceptedFile& off = file_named("off_plain");
  check_refused(off, off.bytes.substr(0, 30), "has room for 3 at most: it is cut off, or that number is wrong");
  const AcceptedFile& legacy = file_named("legacy_3.0_grid_binary_rich");
  check_refused(legacy, legacy.bytes.substr(0, 200), "it is cut off, or that number is wrong");
}

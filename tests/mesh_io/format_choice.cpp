// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/format_choice.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/unread_formats.h"

#include "catch.h"
#include "support/accepted_files.h"
#include "support/says.h"
#include "support/scratch_folder.h"

using accepted_files::AcceptedFile;
using trismooth::choose_format;
using trismooth::FileFormat;
using trismooth::FormatChoice;
using trismooth::MeshDocument;
using trismooth::output_format;
using trismooth::ReadError;
using trismooth::WriteError;

namespace {

bool recognises(FileFormat format, const std::string& bytes) {
  const trismooth::Codec& codec = trismooth::codec_of(format);
  return codec.recognises != nullptr && codec.recognises(bytes);
}

std::vector<FileFormat> recognising(const std::string& bytes) {
  std::vector<FileFormat> found;
  std::ranges::copy_if(trismooth::all_formats(), std::back_inserter(found),
                       [&bytes](FileFormat format) { return recognises(format, bytes); });
  return found;
}

std::string refusal(const std::filesystem::path& path, const std::string& bytes) {
  return message_of<ReadError>([&] { choose_format(path, bytes, std::nullopt); });
}

const std::string off_bytes = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

}  // namespace

TEST_CASE("no file is recognised by a format that it is not of, and a file of its extension is read as before") {
  for (const AcceptedFile& file : accepted_files::all()) {
    CAPTURE(file.name);
    const auto formats = trismooth::formats_of("mesh" + file.extension);
    for (const FileFormat format : recognising(file.bytes)) {
      CAPTURE(to_string(format));
      CHECK(std::ranges::find(formats, format) != formats.end());
    }
    const FormatChoice choice = choose_format("mesh" + file.extension, file.bytes, std::nullopt);
    CHECK(std::ranges::find(formats, choice.format) != formats.end());
    CHECK(choice.note.empty());
  }
}

TEST_CASE("formats with a signature recognise it, others have no function for it") {
  const std::vector<std::pair<FileFormat, std::string>> begins{
      {FileFormat::off, "# a comment\nSTCNOFF\n3 1 0\n"},
      {FileFormat::ply, "ply\r\nformat ascii 1.0\r\n"},
      {FileFormat::stl, "\xEF\xBB\xBFsolid of a plate\n  facet normal 0 0 1\n"},
      {FileFormat::vtk, "# vtk DataFile Version 3.0\nOFF\nASCII\n"},
      {FileFormat::vtu, "<?xml version=\"1.0\"?>\n<!-- a -->\n<VTKFile type='UnstructuredGrid' version=\"1.0\">\n"},
      {FileFormat::vtp, "<VTKFile version=\"0.1\" type=\"PolyData\">"},
      {FileFormat::msh, "\r\n$MeshFormat \r\n"},
      {FileFormat::msh, "$Comments\nx\n"},
      {FileFormat::msh, "$NOD\n"},
      {FileFormat::medit, "# a\n\n\tMeshVersionFormatted 1\n"},
      {FileFormat::su2, "\xEF\xBB\xBF\r\n% a title\r\n  NZONE = 2\r\n"},
      {FileFormat::inp, "\xEF\xBB\xBF\r\n  *heading\r\n"},
      {FileFormat::sms, "MESH2D"},
      {FileFormat::sms, "# one\n  MESH2D # two\n"},
      {FileFormat::nastran, "$ a comment\n\n  begin bulk\r\n"},
      {FileFormat::nastran, "SOL 101\nCEND\nBEGIN BULK\n"},
      {FileFormat::nastran, "ID A,B\nSOL 1\nBEGIN BULK"},
      {FileFormat::nastran, "NASTRAN BUFFSIZE=1\nCEND\nBEGIN BULK\n"},
      {FileFormat::nastran, "GRID,1,,0.\n"},
      {FileFormat::nastran, "GRID*   1\n"},
      {FileFormat::nastran, "\xEF\xBB\xBFgrid\t1\n"},
      {FileFormat::nastran, "$\nCTRIA3  1       1       1       2       3\n"},
  };
  for (const auto& [format, bytes] : begins) {
    CAPTURE(bytes);
    CHECK(recognising(bytes) == std::vector{format});
  }
  CHECK(trismooth::codec_of(FileFormat::obj).recognises == nullptr);
}

TEST_CASE("what only looks similar is recognised by nobody") {
  for (const std::string bytes : {"",
                                  " ",
                                  "\n",
                                  "off we go\n",
                                  "OFFSET 3\n",
                                  "OFF",
                                  "plyboard\n",
                                  "ply\n",
                                  "ply\nfour\n",
                                  "solid\n",
                                  "solid rock\nand more\n",
                                  "<VTKFile",
                                  "<html>",
                                  "# vtk\n",
                                  "3 1 0\n0 0 0\n",
                                  "\xEF\xBB\xBF",
                                  "<VTKFile type=\"ImageData\">",
                                  "NDIME 2\n",
                                  "% NDIME= 2\n",
                                  "title = NDIME= 2\n",
                                  "MESH3D\n",
                                  "mesh2d\n",
                                  "* something else\n",
                                  "4 2 1\n",
                                  "$ only\n",
                                  "GRID of the bay\n4 5\n",
                                  "GRIDS,1\n",
                                  "SOL 101\n",
                                  "ID 1\n",
                                  "BEGIN\n",
                                  "\1"}) {
    CAPTURE(bytes);
    CHECK(recognising(bytes).empty());
    CHECK(recognising(bytes + std::string(100'000, 'x')).empty());
    CHECK(recognising(bytes + std::string(100, '\0')).empty());
  }
}

TEST_CASE("a file whose extension lies is read as what it is, with a note") {
  const ScratchFolder folder;
  for (const AcceptedFile& file : accepted_files::all()) {
    const std::vector<FileFormat> formats = recognising(file.bytes);
    if (formats.size() != 1) {
      continue;
    }
    const std::string other = file.extension == ".ply" ? "mesh.stl" : "mesh.ply";
    CAPTURE(file.name, other);
    const auto path = folder.write(other, file.bytes);
    const auto right_path = folder.write("right" + file.extension, file.bytes);
    const MeshDocument document = trismooth::read_mesh(path);
    const MeshDocument right = trismooth::read_mesh(right_path);
    CHECK(document.format == formats.front());
    CHECK(document.points == right.points);
    REQUIRE(document.notes.size() == right.notes.size() + 1);
    const std::string title(title_of(formats.front()));
    CHECK(document.notes.back() == "the file is " + title + " by its content, not " +
                                       (other == "mesh.ply" ? "PLY" : "STL") + " as its name says: it is read as that");
  }
}

TEST_CASE("a file of a name that names no format is read where its content shows it") {
  const ScratchFolder folder;
  for (const std::string name : {"mesh", "mesh.txt", "mesh.", ".off", "mesh.vol"}) {
    CAPTURE(name);
    const MeshDocument document = trismooth::read_mesh(folder.write(name, off_bytes));
    CHECK(document.format == FileFormat::off);
    CHECK(document.notes ==
          std::vector<std::string>{"the name of the file names no format; it is OFF by its content and read as that"});
  }
}

TEST_CASE("a format that is told is that of files whose name says none, and of no others") {
  const std::string headless = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(choose_format("mesh.dat", headless, FileFormat::off).format == FileFormat::off);
  CHECK(choose_format("mesh.ply", "ply\n", FileFormat::off).format == FileFormat::ply);
  const FormatChoice choice = choose_format("mesh", off_bytes, FileFormat::vtk);
  CHECK(choice.format == FileFormat::off);
  CHECK(choice.note == "the file is OFF by its content, not legacy VTK as was told: it is read as that");
}

TEST_CASE("what no format recognises is left to the format of the extension, whose reader says what is wrong") {
  const ScratchFolder folder;
  const auto path = folder.write("mesh.ply", "no mesh\n");
  CHECK(says(message_of<ReadError>([&] { trismooth::read_mesh(path); }), "mesh.ply:1: is not a PLY file"));
  // OBJ shows nothing: its files are not taken from it.
  CHECK(choose_format("mesh.obj", off_bytes, std::nullopt).format == FileFormat::obj);
}

TEST_CASE("an unknown extension is told with all that are known, and the one that may be meant") {
  CHECK(refusal("mesh.foo", "?") ==
        "mesh.foo: the extension '.foo' names no format, and the content does not show one; "
        "--format NAME tells it: " +
            trismooth::format_names());
  CHECK(says(refusal("mesh.offf", "?"), "the extension '.offf' names no format (did you mean '.off'?)"));
  CHECK(says(refusal("mesh", "?"), "mesh: has no extension that names a format"));
  CHECK(says(trismooth::titled_format_list(), "OFF (.off), OBJ (.obj), PLY (.ply), STL (.stl), legacy VTK (.vtk)"));
  const std::string message = message_of<WriteError>([] { output_format("out.foo"); });
  CHECK(message ==
        "out.foo: the extension '.foo' names no format; --format NAME tells it; known are " + trismooth::format_list());
}

TEST_CASE("formats that are known and not read are named, with a way to a file that is") {
  const std::string refused = refusal("plate.VOL", "?");
  CHECK(refused ==
        "plate.VOL: is Netgen, which is not read; 'meshio convert in.vol out.vtu' makes a file that is; "
        "known are " +
            trismooth::format_names());
  CHECK(
      says(refusal("plate.cdb", "?"), "plate.cdb: is an Ansys archive (CDB), which is not read; known are off, obj, "));
  const std::map<std::string, std::string> by_content{
      {"\x89HDF\r\n\x1a\n....", "is HDF5"},
      {"CDF\x02....", "is NetCDF without a mesh"},
      {"(0 \"GAMBIT to Fluent File\")\n", "is Ansys Fluent"},
      {"(0 grid written by a program)\n(2 2)\n", "is Ansys Fluent"},
      {"mesh3d\ndimension\n2\n", "is Netgen"},
      {"# plate.msh; created by JIGSAW\nMSHID=3;EUCLIDEAN-MESH\nNDIMS=2\n", "is JIGSAW"},
      {"100079  1000  4  UTM-33\r\n1 0 0 -5 1\r\n", "is MIKE (DHI)"},
      {"4 PROJCS[\"UTM-33\",GEOGCS[\"Unused\"]]\n1 0 0 -5 1\n", "is MIKE (DHI)"},
      {std::string("\xFF\xFEO\0F\0F\0", 8), "is text in UTF-16"},
      {std::string("O\0F\0F\0\r\0\n\0003\0 \0001\0", 16), "is text in UTF-16"},
  };
  for (const auto& [bytes, words] : by_content) {
    CAPTURE(bytes);
    CHECK(says(refusal("plate.dat", bytes), words));
    CHECK(says(refusal("plate.off", bytes), words));
    CHECK(says(refusal("plate.msh", bytes), words));
    // A grid of ADCIRC may begin with any text, but is text.
    const bool has_zeros = bytes.find('\0') != std::string::npos;
    CHECK((has_zeros || choose_format("plate.grd", bytes, std::nullopt).format == FileFormat::adcirc));
    CHECK((!has_zeros || says(refusal("plate.grd", bytes), words)));
  }
  for (const std::string bytes : {"", "CDF", "CDF\x07", "-1 2411\n", "(0 )", "-1\n", "-1"}) {
    CAPTURE(bytes);
    CHECK_FALSE(trismooth::recognise_unread_format(bytes));
  }
  CHECK(says(message_of<WriteError>([] { output_format("out.cdb"); }),
             "out.cdb: an Ansys archive (CDB) is not written; known are off, obj"));
}

TEST_CASE("numbers of an XDMF mesh lead to it, and netCDF-4 is not called HDF5") {
  const ScratchFolder folder;
  const std::string hdf5 = "\x89HDF\r\n\x1a\n" + std::string(4, '\0');
  CHECK(says(refusal(folder / "box.h5", hdf5), "(of XDMF give the .xdmf file)"));
  std::ofstream(folder / "box.xmf") << "<Xdmf/>";
  CHECK(refusal(folder / "box.h5", hdf5) ==
        (folder / "box.h5").string() + ": has numbers of an XDMF mesh: give " + (folder / "box.xmf").string());
  CHECK(says(refusal(folder / "wind.nc4", hdf5 + "_NCProperties"), "is NetCDF without a mesh"));
}

TEST_CASE("no extension of a format that is read names one that is not") {
  for (const FileFormat format : trismooth::all_formats()) {
    for (const std::string_view extension : extensions_of(format)) {
      CAPTURE(extension);
      CHECK_FALSE(trismooth::unread_format_of("mesh" + std::string(extension)));
    }
  }
}

TEST_CASE("the extension of the output decides; of formats that share one the document's is kept") {
  for (const FileFormat format : trismooth::all_formats()) {
    for (const std::string_view extension : extensions_of(format)) {
      CAPTURE(to_string(format), extension);
      const std::string path = "out" + std::string(extension);
      CHECK(output_format(path) == trismooth::formats_of(path).front());
      CHECK(output_format(path, format) == format);
      CHECK(output_format(path, format, FileFormat::off) == format);
      CHECK(output_format(path + ".gz", format) == format);
    }
  }
  CHECK(output_format("out.vtk", FileFormat::off) == FileFormat::vtk);
}

TEST_CASE("a stream is written as was told, or as the document was read") {
  CHECK(output_format("-", FileFormat::ply) == FileFormat::ply);
  CHECK(output_format("-", FileFormat::ply, FileFormat::vtk) == FileFormat::vtk);
  CHECK(output_format("out.foo", FileFormat::ply, FileFormat::vtk) == FileFormat::vtk);
  CHECK(says(message_of<WriteError>([] { output_format("-"); }), "standard output: nothing says its format"));
  CHECK_FALSE(message_of<WriteError>([] { output_format("out.foo", FileFormat::ply); }).empty());
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/file_format.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"

#include "catch.h"

using trismooth::all_formats;
using trismooth::FileFormat;
using trismooth::format_of;
using trismooth::formats_of;

namespace {

std::string upper(std::string_view text) {
  std::string changed(text);
  for (char& c : changed) {
    c = 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return changed;
}

}  // namespace

TEST_CASE("extensions name these formats") {
  // Short names of the formats, in the order in which the content of a file is asked.
  const std::map<std::string, std::vector<std::string>> documented{
      {".off", {"off"}},
      {".obj", {"obj"}},
      {".ply", {"ply"}},
      {".stl", {"stl"}},
      {".vtk", {"vtk"}},
      {".vtu", {"vtu"}},
      {".vtp", {"vtp"}},
      {".mesh", {"medit", "mfem"}},
      {".su2", {"su2"}},
      {".14", {"adcirc"}},
      {".grd", {"adcirc"}},
      {".gr3", {"adcirc"}},
      {".ll", {"adcirc"}},
      {".meshb", {"medit"}},
      {".msh", {"msh", "freefem"}},
      {".node", {"triangle"}},
      {".ele", {"triangle"}},
      {".2dm", {"2dm"}},
      {".inp", {"inp"}},
      {".bdf", {"nastran"}},
      {".nas", {"nastran"}},
      {".unv", {"unv"}},
      {".xdmf", {"xdmf"}},
      {".xmf", {"xdmf"}},
      {".cgns", {"cgns"}},
      {".med", {"med"}},
      {".rmed", {"med"}},
      {".mmed", {"med"}},
      {".slf", {"selafin"}},
      {".srf", {"selafin"}},
      {".sel", {"selafin"}},
  };
  for (const auto& [extension, formats] : documented) {
    CAPTURE(extension);
    std::vector<std::string> named;
    for (const FileFormat format : formats_of("mesh" + extension)) {
      named.emplace_back(to_string(format));
    }
    CHECK(named == formats);
  }
}

TEST_CASE("every format is named by its extensions, in any case of letters and in any folder") {
  std::set<std::string_view> names;
  std::set<std::string_view> titles;
  for (const FileFormat format : all_formats()) {
    CAPTURE(to_string(format));
    CHECK(trismooth::codec_of(format).description.format == format);
    names.insert(to_string(format));
    titles.insert(title_of(format));
    CHECK(trismooth::format_named(to_string(format)) == format);
    CHECK_FALSE(extensions_of(format).empty());
    for (const std::string_view extension : extensions_of(format)) {
      const auto is_named = [format](const std::string& path) {
        return std::ranges::count(formats_of(path), format) == 1;
      };
      const std::string usual(extension);
      CHECK(usual.starts_with('.'));
      CHECK(is_named("mesh" + usual));
      CHECK(is_named("a.b/c.d" + usual));
      CHECK(is_named("mesh" + upper(usual)));
      CHECK(is_named("mesh" + upper(usual.substr(0, 2)) + usual.substr(2)));
      CHECK(trismooth::format_list().find(usual) != std::string::npos);
      CHECK(format_of("mesh" + usual) == formats_of("mesh" + usual).front());
    }
  }
  CHECK(names.size() == all_formats().size());
  CHECK(titles.size() == all_formats().size());
  CHECK_FALSE(trismooth::format_named(""));
  CHECK_FALSE(trismooth::format_named("none"));
}

TEST_CASE("a build reads and writes what its list of formats says, in the order of the enumeration") {
  CHECK(trismooth::format_list().starts_with(".off, .obj, .ply, .stl, .vtk"));
  for (const FileFormat format : all_formats()) {
    CHECK((is_available(format) || format == FileFormat::vtu || format == FileFormat::vtp));
  }
  // The tests themselves need VTK.
  CHECK(std::ranges::all_of(all_formats(), &trismooth::is_available));
}

TEST_CASE("the last extension counts, and nothing else of the name") {
  CHECK(format_of("mesh.off.obj") == FileFormat::obj);
  for (const char* path : {"", "off", ".off", "mesh.", "mesh.of", "mesh.offf", "mesh.off/", "mesh. off"}) {
    CAPTURE(path);
    CHECK_FALSE(format_of(path));
  }
}

TEST_CASE("VTK's formats, MSH, PLY, XDMF, Exodus, MED and CGNS hold arrays") {
  for (const FileFormat format : {FileFormat::vtk, FileFormat::vtu, FileFormat::vtp, FileFormat::msh, FileFormat::ply,
                                  FileFormat::xdmf, FileFormat::exodus, FileFormat::med, FileFormat::cgns}) {
    CHECK(has_arrays(format));
  }
  for (const FileFormat format : {FileFormat::off, FileFormat::obj, FileFormat::stl, FileFormat::nastran}) {
    CHECK_FALSE(has_arrays(format));
  }
}

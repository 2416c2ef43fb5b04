#include "trismooth/mesh_io/file_format.h"

#include <algorithm>
#include <set>
#include <string>

#include "catch.h"

using trismooth::all_formats;
using trismooth::FileFormat;
using trismooth::format_of;

TEST_CASE("every format is named by its extension, in any case of letters and in any folder") {
  std::set<std::string> names;
  for (const FileFormat format : all_formats()) {
    const std::string name(to_string(format));
    names.insert(name);
    CHECK(format_of("mesh." + name) == format);
    CHECK(format_of("a.b/c.d." + name) == format);
    std::string upper = name;
    for (char& c : upper) {
      c = static_cast<char>(c - 'a' + 'A');
    }
    CHECK(format_of("mesh." + upper) == format);
    upper[0] = name[0];
    CHECK(format_of("mesh." + upper) == format);
    CHECK(trismooth::format_list().find("." + name) != std::string::npos);
  }
  CHECK(names == std::set<std::string>{"obj", "off", "ply", "stl", "vtk", "vtp", "vtu"});
}

TEST_CASE("a build reads and writes what its list of formats says, in the order of the enumeration") {
  std::string list;
  for (const FileFormat format : all_formats()) {
    CHECK((is_available(format) || format == FileFormat::vtu || format == FileFormat::vtp));
    if (is_available(format)) {
      list.append(list.empty() ? "." : ", .").append(to_string(format));
    }
  }
  CHECK(trismooth::format_list() == list);
  CHECK(list.starts_with(".off, .obj, .ply, .stl, .vtk"));
  // The tests themselves need VTK.
  CHECK(std::ranges::all_of(all_formats(), &trismooth::is_available));
}

TEST_CASE("the last extension counts, and nothing else of the name") {
  CHECK(format_of("mesh.off.obj") == FileFormat::obj);
  for (const char* path :
       {"", "off", ".off", "mesh.", "mesh.of", "mesh.offf", "mesh.off.gz", "mesh.off/", "mesh. off"}) {
    CAPTURE(path);
    CHECK_FALSE(format_of(path));
  }
}

TEST_CASE("VTK's formats hold arrays, the others do not") {
  for (const FileFormat format : all_formats()) {
    CAPTURE(to_string(format));
    CHECK(has_arrays(format) == (to_string(format)[0] == 'v'));
  }
}

#include "trismooth/mesh_io/file_format.h"

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

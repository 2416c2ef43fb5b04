// SPDX-License-Identifier: BSD-3-Clause
// Cells with fewer vertices than their type needs. VTK's classes stop the program on some of them when the mesh is
// written, and no other format holds them: they are refused when they are read.
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"

using accepted_files::AcceptedFile;

namespace {

struct Group {
  std::string_view vtp_name;
  std::string_view legacy_name;
  std::size_t least;  ///< vertices of a cell
};

constexpr std::array groups{Group{"Verts", "VERTICES", 1}, Group{"Lines", "LINES", 2}, Group{"Polys", "POLYGONS", 3},
                            Group{"Strips", "TRIANGLE_STRIPS", 3}};

constexpr std::string_view indices = " 0 1 2 3";
constexpr std::string_view legacy_points = "0 0 0 1 0 0 1 1 0 0 1 0\n";

AcceptedFile vtp(const Group& group, std::size_t vertices) {
  return {"sizes", ".vtp",
          fmt::format("<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"4\" NumberOf{0}=\"1\">"
                      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">{1}</DataArray></Points><{0}>"
                      "<DataArray type=\"Int64\" Name=\"connectivity\">{2}</DataArray>"
                      "<DataArray type=\"Int64\" Name=\"offsets\">{3}</DataArray></{0}></Piece></PolyData></VTKFile>",
                      group.vtp_name, legacy_points, indices.substr(0, 2 * vertices), vertices)};
}

AcceptedFile vtu(int type, std::size_t vertices) {
  return {"sizes", ".vtu",
          fmt::format("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"
                      "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">"
                      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">{}</DataArray></Points><Cells>"
                      "<DataArray type=\"Int64\" Name=\"connectivity\">{}</DataArray>"
                      "<DataArray type=\"Int64\" Name=\"offsets\">{}</DataArray>"
                      "<DataArray type=\"UInt8\" Name=\"types\">{}</DataArray></Cells>"
                      "</Piece></UnstructuredGrid></VTKFile>",
                      legacy_points, indices.substr(0, 2 * vertices), vertices, type)};
}

AcceptedFile legacy(const Group& group, std::size_t vertices) {
  return {"sizes", ".vtk",
          fmt::format("# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n{}{} 1 {}\n{}{}\n",
                      legacy_points, group.legacy_name, vertices + 1, vertices, indices.substr(0, 2 * vertices))};
}

AcceptedFile legacy(int type, std::size_t vertices) {
  return {"sizes", ".vtk",
          fmt::format(
              "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n{}CELLS 1 {}\n{}{}\n"
              "CELL_TYPES 1\n{}\n",
              legacy_points, vertices + 1, vertices, indices.substr(0, 2 * vertices), type)};
}

void check(const AcceptedFile& file, std::size_t vertices, bool sound) {
  INFO(file.bytes);
  const Outcome outcome = read_and_write(file, file.bytes);
  INFO(outcome.message);
  CHECK(outcome.fault == "");
  CHECK(outcome.document.has_value() == sound);
  CHECK((sound || outcome.message.find(fmt::format("has {} vert", vertices)) != std::string::npos));
}

}  // namespace

TEST_CASE("Cells of too few vertices are refused in every group of a VTP and a legacy POLYDATA") {
  for (const Group& group : groups) {
    for (std::size_t vertices = 0; vertices <= 4; ++vertices) {
      check(vtp(group, vertices), vertices, vertices >= group.least);
      check(legacy(group, vertices), vertices, vertices >= group.least);
    }
  }
}

TEST_CASE("Cells whose vertices are too few or too many for their type are refused in VTU and legacy grids") {
  constexpr std::array<std::array<std::size_t, 2>, 11> sizes{
      {{0, 0}, {1, 1}, {1, 4}, {2, 2}, {2, 4}, {3, 3}, {3, 4}, {3, 4}, {4, 4}, {4, 4}, {4, 4}}};
  for (std::size_t type = 0; type < sizes.size(); ++type) {
    for (std::size_t vertices = 0; vertices <= 4; ++vertices) {
      const bool sound = sizes[type][0] <= vertices && vertices <= sizes[type][1];
      check(vtu(static_cast<int>(type), vertices), vertices, sound);
      check(legacy(static_cast<int>(type), vertices), vertices, sound);
    }
  }
}

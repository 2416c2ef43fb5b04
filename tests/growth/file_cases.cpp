// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include "cases.h"
#include "support/hostile_meshes.h"
#include "tool_runs.h"

namespace {

/// Smooths a file that has much to be said of, and says it everywhere. What the page of a small mesh takes has more to
/// do with the picture on it than with the size of the mesh: `reports` spares those that grow with it.
GrowthCase told_of(const std::string& name, int size, const std::string& input, std::string (*make)(int),
                   const std::vector<std::string>& reports = {"report.json", "report.html"}) {
  return {name + ": " + input + " to reports", size, [=](int count, const ScratchFolder& folder) {
            const std::string from = folder.write("in." + input, make(count));
            const std::string to = folder / "out.off";
            std::vector<std::filesystem::path> files;
            for (const std::string& report : reports) {
              files.emplace_back(folder / report);
            }
            return [=] { run_tool(from, to, files); };
          }};
}

/// One free vertex opposite of every edge of the boundary.
std::string star_off(int size) {
  return off_text(test_meshes::star(size));
}

/// A chain of vertices in a mesh of quadrilaterals, or of some that are not listed in turn.
std::string quadrilaterals_off(const mixed_meshes::MixedMesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << mesh.points.size() << ' ' << mesh.elements.size() << " 0\n";
  for (const auto& [x, y] : mesh.points) {
    text << x << ' ' << y << " 0\n";
  }
  for (const auto& [a, b, c, d] : mesh.elements) {
    text << "4 " << a << ' ' << b << ' ' << c << ' ' << d << '\n';
  }
  return text.str();
}
std::string chain_of_quadrilaterals(int size) {
  return quadrilaterals_off(hostile_meshes::in_quadrilaterals(hostile_meshes::chain(size)));
}
std::string quadrilaterals_not_in_turn(int size) {
  mixed_meshes::MixedMesh mesh(size, 3, 0.1, 1, 0);
  for (std::size_t e = 0; e < mesh.elements.size(); e += 3) {
    std::swap(mesh.elements[e][2], mesh.elements[e][3]);
  }
  return quadrilaterals_off(mesh);
}

/// Four triangles around a vertex, in the words of a format: made up to by many times something else. They are flat, so
/// that the picture on a page is small: it takes no longer than what is told of.
constexpr std::string_view vtk_begin = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n";
constexpr std::string_view vtk_points = " double\n0 0 0 1 0 0 1 .1 0 0 .1 0 .6 .07 0\n";
constexpr std::string_view vtk_cells =
    "CELLS 4 16\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
    "CELL_TYPES 4\n5 5 5 5\n";
constexpr std::string_view vtu_begin = "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>\n";
constexpr std::string_view vtu_points_and_cells =
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0 1 0 0 1 .1 0 0 .1 0 .6 .07 "
    "0</DataArray></Points>"
    "<Cells><DataArray type=\"Int32\" Name=\"connectivity\">0 1 4 1 2 4 2 3 4 3 0 4</DataArray>"
    "<DataArray type=\"Int32\" Name=\"offsets\">3 6 9 12</DataArray>"
    "<DataArray type=\"UInt8\" Name=\"types\">5 5 5 5</DataArray></Cells></Piece>\n";
constexpr std::string_view vtu_end = "</UnstructuredGrid></VTKFile>\n";

/// A mesh, and point data to come.
std::string vtk_head() {
  return std::string(vtk_begin) + "POINTS 5" + std::string(vtk_points) + std::string(vtk_cells) + "POINT_DATA 5\n";
}

/// Many cell arrays, each of which might give regions, and as many points that no cell uses.
std::string vtk_unused_points(int count) {
  return std::string(vtk_begin) + "POINTS " + std::to_string(100 * count + 5) + std::string(vtk_points) +
         repeated(100 * count, [](const auto&) { return "0 0 0\n"; }) + std::string(vtk_cells) +
         "CELL_DATA 4\nFIELD F " + std::to_string(count) + "\n" +
         repeated(count, [](const auto& number) { return "a" + number + " 1 4 int\n0 0 1 1\n"; });
}

/// A fan of triangles of which every four are in two of many groups, and listed for each of them.
std::string vtk_overlapping_groups(int count) {
  const auto number = [](const std::string& text, int more) { return std::to_string(std::stoi(text) + more); };
  const auto triangles = [&] {
    return repeated(count, [&](const auto& i) { return "3 0 " + number(i, 1) + " " + number(i, 2) + "\n"; });
  };
  const auto groups = [&](int more) {
    return repeated(count, [&](const auto& i) { return std::to_string(std::stoi(i) / 4 + more) + "\n"; });
  };
  const std::string cells = std::to_string(2 * count);
  return std::string(vtk_begin) + "POINTS " + std::to_string(count + 2) + " double\n0 1 0\n" +
         repeated(count + 1, [](const auto& i) { return i + " 0 0\n"; }) + "CELLS " + cells + " " +
         std::to_string(8 * count) + "\n" + triangles() + triangles() + "CELL_TYPES " + cells + "\n" +
         repeated(2 * count, [](const auto&) { return "5\n"; }) + "CELL_DATA " + cells +
         "\nSCALARS material int 1\nLOOKUP_TABLE default\n" + groups(0) + groups(1);
}

std::string vtk_fields(int count, const std::string& name) {
  return vtk_head() + "FIELD F " + std::to_string(count) + "\n" + repeated(count, [&](const auto& number) {
           return (name.empty() ? "a" + number : name) + " 1 5 int\n0 0 0 0 0\n";
         });
}
std::string vtk_fields_of_one_name(int count) {
  return vtk_fields(count, "a");
}
std::string vtk_distinct_fields(int count) {
  return vtk_fields(count, "");
}
std::string vtk_strings(int count) {
  return vtk_head() + "FIELD F " + std::to_string(count) + "\n" + repeated(count, [](const auto& number) {
           return "s" + number + " 1 5 string\na\nb\nc\nd\ne\nMETADATA\nINFORMATION 0\n\n";
         });
}
std::string vtk_lookup_tables(int count) {
  return vtk_head() + repeated(count, [](const auto& number) {
           return "LOOKUP_TABLE t" + number + " 1\n0 0 0 1\nSCALARS s" + number + " int 1\nLOOKUP_TABLE t" + number +
                  "\n1 2 3 4 5\n";
         });
}

std::string vtu_fields(int count) {
  return std::string(vtu_begin) + "<FieldData>" +
         repeated(count,
                  [](const auto& number) {
                    return "<DataArray type=\"Int8\" Name=\"a" + number + "\" NumberOfTuples=\"1\">1</DataArray>\n";
                  }) +
         "</FieldData><Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">" + std::string(vtu_points_and_cells) +
         std::string(vtu_end);
}

std::string vtu_point_arrays(int count, const std::string& name) {
  return std::string(vtu_begin) + "<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\"><PointData>" +
         repeated(count,
                  [&](const auto& number) {
                    return "<DataArray type=\"Int8\" Name=\"" + (name.empty() ? "a" + number : name) +
                           "\">1 2 3 4 5</DataArray>\n";
                  }) +
         "</PointData>" + std::string(vtu_points_and_cells) + std::string(vtu_end);
}
std::string vtu_distinct_point_arrays(int count) {
  return vtu_point_arrays(count, "");
}
std::string vtu_point_arrays_of_one_name(int count) {
  return vtu_point_arrays(count, "a");
}

std::string vtu_pieces(int count) {
  return std::string(vtu_begin) +
         repeated(count,
                  [](const auto&) {
                    return "<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\"><PointData>"
                           "<DataArray type=\"Int8\" Name=\"a\">1 2 3 4 5</DataArray></PointData>" +
                           std::string(vtu_points_and_cells);
                  }) +
         std::string(vtu_end);
}

/// One triangle as VTK compresses it, many times.
std::string vtu_compressed_pieces(int count) {
  const vtkNew<vtkUnstructuredGrid> grid;
  const vtkNew<vtkPoints> points;
  for (const auto& [x, y] : {std::array{0, 0}, std::array{1, 0}, std::array{0, 1}}) {
    points->InsertNextPoint(x, y, 0);
  }
  grid->SetPoints(points);
  grid->Allocate(1);
  constexpr std::array<vtkIdType, 3> corners{0, 1, 2};
  constexpr int triangle = 5;
  grid->InsertNextCell(triangle, 3, corners.data());
  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  const vtkNew<vtkZLibDataCompressor> compressor;
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  writer->SetCompressor(compressor);
  writer->WriteToOutputStringOn();
  writer->Write();
  const std::string whole = writer->GetOutputString();
  constexpr std::string_view end_of_piece = "</Piece>";
  const std::size_t begin = whole.find("<Piece");
  const std::size_t end = whole.find(end_of_piece) + end_of_piece.size();
  return whole.substr(0, begin) + repeated(count, [&](const auto&) { return whole.substr(begin, end - begin); }) +
         whole.substr(end);
}

std::string vtu_unknown_elements(int count) {
  return std::string(vtu_begin) +
         repeated(count,
                  [](const auto& number) { return "<Unknown name=\"" + number + "\"/>\n<!-- a comment -->\n"; }) +
         "<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">" + std::string(vtu_points_and_cells) + std::string(vtu_end);
}

std::string vtu_information_keys(int count) {
  return std::string(vtu_begin) + "<FieldData><DataArray type=\"Int8\" Name=\"a\" NumberOfTuples=\"1\">1" +
         repeated(count,
                  [](const auto& number) {
                    return "<InformationKey name=\"k" + number + "\" location=\"l\">1</InformationKey>\n";
                  }) +
         "</DataArray></FieldData><Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">" +
         std::string(vtu_points_and_cells) + std::string(vtu_end);
}

/// A comment of `count` KiB.
std::string vtu_long_comment(int count) {
  constexpr std::size_t kibibyte = 1024;
  return "<!-- " + std::string(kibibyte * static_cast<std::size_t>(count), '.') + " -->" + std::string(vtu_begin) +
         "<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">" + std::string(vtu_points_and_cells) + std::string(vtu_end);
}

std::string stl_of_one_slot(int facets) {
  std::string text = "solid a\n";
  const auto points = hostile_meshes::points_of_one_slot(3 * static_cast<std::size_t>(facets));
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<char, 64> vertex{};
    std::snprintf(vertex.data(), vertex.size(), "vertex 0 0 %.17g\n", points[i][2]);
    text += i % 3 == 0 ? "facet normal 0 0 1\nouter loop\n" : "";
    text += vertex.data();
    text += i % 3 == 2 ? "endloop\nendfacet\n" : "";
  }
  return text + "endsolid a\n";
}

constexpr std::string_view stl_facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string stl_solids(int count) {
  return repeated(count,
                  [](const auto& number) { return "solid s" + number + "\n" + std::string(stl_facet) + "endsolid\n"; });
}

std::string obj_groups(int count) {
  return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .6 .7 0\n" +
         repeated(count,
                  [](const auto& number) {
                    return "usemtl m" + number + "\ng g" + number + "\no o" + number + "\nf 1 2 5\n";
                  }) +
         "f 2 3 5\nf 3 4 5\nf 4 1 5\n";
}

std::string ply_file(const std::string& elements, const std::string& properties, const std::string& row,
                     const std::string& rows) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\n" +
      properties + "element face 4\nproperty list uchar int vertex_indices\n" + elements + "end_header\n";
  for (const char* const point : {"0 0 0", "1 0 0", "1 1 0", "0 1 0", ".6 .7 0"}) {
    text += point + row + "\n";
  }
  return text + "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n" + rows;
}
std::string ply_properties(int count) {
  return ply_file("", repeated(count, [](const auto& number) { return "property int p" + number + "\n"; }),
                  repeated(count, [](const auto&) { return " 1"; }), "");
}
std::string ply_lists(int count) {
  return ply_file("", repeated(count, [](const auto& number) { return "property list uchar int p" + number + "\n"; }),
                  repeated(count, [](const auto&) { return " 0"; }), "");
}
std::string ply_elements(int count) {
  return ply_file(repeated(count, [](const auto& number) { return "element e" + number + " 1\nproperty int p\n"; }), "",
                  "", repeated(count, [](const auto&) { return "1\n"; }));
}

}  // namespace

std::vector<GrowthCase> file_cases() {
  std::vector<GrowthCase> cases;
  for (const char* const format : {"off", "obj", "ply", "stl", "vtk", "vtu", "vtp"}) {
    cases.push_back(chain_in(format, format));
  }
  for (const char* const format : {"ply", "stl", "vtu"}) {
    cases.push_back(file_case("a chain of vertices", 100, "off", format, &chain_off_text));
  }
  for (const char* const format : {"vtu", "ply", "stl"}) {
    cases.push_back(file_case("arrays of one name", 100, "vtk", format, &vtk_fields_of_one_name));
  }
  cases.push_back(file_case("arrays of one name", 100, "vtu", "vtk", &vtu_point_arrays_of_one_name));
  cases.push_back(file_case("arrays of one name", 100, "vtu", "vtu", &vtu_point_arrays_of_one_name));
  for (const char* const format : {"vtu", "off"}) {
    cases.push_back(file_case("point arrays", 100, "vtk", format, &vtk_distinct_fields));
  }
  cases.push_back(file_case("point arrays", 100, "vtu", "vtu", &vtu_distinct_point_arrays));
  cases.insert(cases.end(), {
                                file_case("a fan of one vertex", 300, "off", "off", &star_off),
                                file_case("a chain in quadrilaterals", 100, "off", "vtk", &chain_of_quadrilaterals),
                                told_of("quadrilaterals that are not in turn", 100, "off", &quadrilaterals_not_in_turn,
                                        {"report.json"}),
                                file_case("field arrays", 300, "vtu", "vtu", &vtu_fields),
                                told_of("arrays of strings", 100, "vtk", &vtk_strings),
                                file_case("lookup tables", 100, "vtk", "vtu", &vtk_lookup_tables),
                                file_case("pieces", 50, "vtu", "vtu", &vtu_pieces),
                                file_case("compressed pieces", 30, "vtu", "vtk", &vtu_compressed_pieces),
                                told_of("elements that are not known", 300, "vtu", &vtu_unknown_elements),
                                file_case("information keys", 300, "vtu", "vtu", &vtu_information_keys),
                                file_case("a long comment", 192, "vtu", "off", &vtu_long_comment),
                                file_case("cell arrays and unused points", 30, "vtk", "off", &vtk_unused_points),
                                file_case("points of one slot", 100, "stl", "off", &stl_of_one_slot),
                                file_case("solids", 100, "stl", "vtu", &stl_solids),
                                file_case("groups and materials", 100, "obj", "vtu", &obj_groups),
                                told_of("groups that overlap", 600, "vtk", &vtk_overlapping_groups),
                                file_case("properties", 100, "ply", "ply", &ply_properties),
                                file_case("properties", 100, "ply", "vtu", &ply_properties),
                                file_case("lists", 100, "ply", "vtu", &ply_lists),
                                file_case("elements", 100, "ply", "vtu", &ply_elements),
                            });
  return cases;
}

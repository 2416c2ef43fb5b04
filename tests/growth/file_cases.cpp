#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
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

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/cli/command_line.h"

#include "cases.h"
#include "support/hostile_meshes.h"

namespace {

using test_meshes::Mesh;
using Words = std::vector<std::string>;

void run_tool(Words words) {
  words.insert(words.begin(), {"trismooth", "smooth"});
  words.insert(words.end(), {"--backend", "cpu", "--threads", "1", "--max-sweeps", "2"});
  std::vector<const char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  std::ostringstream out;
  std::ostringstream err;
  if (trismooth::run_command_line(static_cast<int>(arguments.size()), arguments.data(), {out, err}) != 0) {
    std::fputs(err.str().c_str(), stdout);
    std::exit(1);
  }
}

/// Smooths a file with the bytes make(size), named `input`, to one named `output`.
GrowthCase file(const std::string& name, int size, const std::string& input, const std::string& output,
                std::string (*make)(int)) {
  return {name + ": " + input + " to " + output, size, [=](int count, const ScratchFolder& folder) {
            const std::string from = folder.write("in." + input, make(count));
            const std::string to = folder / ("out." + output);
            return [=] { run_tool({from, to}); };
          }};
}

/// The same, with a file that has much to be said of, and everything that says it.
GrowthCase told_of(const std::string& name, int size, const std::string& input, std::string (*make)(int)) {
  return {name + ": " + input + " to reports", size, [=](int count, const ScratchFolder& folder) {
            const std::string from = folder.write("in." + input, make(count));
            const std::string to = folder / "out.off";
            const std::string json = folder / "report.json";
            const std::string page = folder / "report.html";
            return [=] { run_tool({from, to, "--verbose", "--report", json, "--report", page}); };
          }};
}

std::string off_of(const Mesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const auto& point : mesh.points) {
    text << point.x << ' ' << point.y << " 0\n# a comment\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "3 " << a << ' ' << b << ' ' << c << '\n';
  }
  return text.str();
}

std::string chain_off(int length) {
  return off_of(hostile_meshes::chain(length));
}

/// One free vertex opposite of every edge of the boundary.
std::string star_off(int size) {
  return off_of(test_meshes::star(size));
}

/// The chain in another format, as this program writes it.
GrowthCase chain_in(const std::string& format) {
  return {"a chain of vertices: " + format + " to " + format, 100, [=](int count, const ScratchFolder& folder) {
            const std::string off = folder.write("chain.off", chain_off(count));
            const std::string from = folder / ("in." + format);
            const std::string to = folder / ("out." + format);
            write_mesh(from, trismooth::read_mesh(off));
            return [=] { run_tool({from, to}); };
          }};
}

/// Four triangles around a vertex, in the words of a format: made up to by many times something else.
constexpr std::string_view vtk_begin = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n";
constexpr std::string_view vtk_points = " double\n0 0 0 1 0 0 1 1 0 0 1 0 .6 .7 0\n";
constexpr std::string_view vtk_cells =
    "CELLS 4 16\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
    "CELL_TYPES 4\n5 5 5 5\n";
constexpr std::string_view vtu_begin = "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>\n";
constexpr std::string_view vtu_points_and_cells =
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0 1 0 0 1 1 0 0 1 0 .6 .7 0</DataArray></Points>"
    "<Cells><DataArray type=\"Int32\" Name=\"connectivity\">0 1 4 1 2 4 2 3 4 3 0 4</DataArray>"
    "<DataArray type=\"Int32\" Name=\"offsets\">3 6 9 12</DataArray>"
    "<DataArray type=\"UInt8\" Name=\"types\">5 5 5 5</DataArray></Cells></Piece>\n";
constexpr std::string_view vtu_end = "</UnstructuredGrid></VTKFile>\n";

template <class Part>
std::string repeated(int count, const Part& part) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += part(std::to_string(i));
  }
  return text;
}

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
    cases.push_back(chain_in(format));
  }
  for (const char* const format : {"ply", "stl", "vtu"}) {
    cases.push_back(file("a chain of vertices", 100, "off", format, &chain_off));
  }
  for (const char* const format : {"vtu", "ply", "stl"}) {
    cases.push_back(file("arrays of one name", 100, "vtk", format, &vtk_fields_of_one_name));
  }
  cases.push_back(file("arrays of one name", 100, "vtu", "vtk", &vtu_point_arrays_of_one_name));
  cases.push_back(file("arrays of one name", 100, "vtu", "vtu", &vtu_point_arrays_of_one_name));
  for (const char* const format : {"vtu", "off"}) {
    cases.push_back(file("point arrays", 100, "vtk", format, &vtk_distinct_fields));
  }
  cases.push_back(file("point arrays", 100, "vtu", "vtu", &vtu_distinct_point_arrays));
  cases.insert(cases.end(), {
                                file("a fan of one vertex", 300, "off", "off", &star_off),
                                file("field arrays", 300, "vtu", "vtu", &vtu_fields),
                                told_of("arrays of strings", 100, "vtk", &vtk_strings),
                                file("lookup tables", 100, "vtk", "vtu", &vtk_lookup_tables),
                                file("pieces", 50, "vtu", "vtu", &vtu_pieces),
                                file("compressed pieces", 30, "vtu", "vtk", &vtu_compressed_pieces),
                                told_of("elements that are not known", 300, "vtu", &vtu_unknown_elements),
                                file("information keys", 300, "vtu", "vtu", &vtu_information_keys),
                                file("a long comment", 192, "vtu", "off", &vtu_long_comment),
                                file("cell arrays and unused points", 30, "vtk", "off", &vtk_unused_points),
                                file("points of one slot", 100, "stl", "off", &stl_of_one_slot),
                                file("solids", 100, "stl", "vtu", &stl_solids),
                                file("groups and materials", 100, "obj", "vtu", &obj_groups),
                                file("properties", 100, "ply", "ply", &ply_properties),
                                file("properties", 100, "ply", "vtu", &ply_properties),
                                file("lists", 100, "ply", "vtu", &ply_lists),
                                file("elements", 100, "ply", "vtu", &ply_elements),
                            });
  return cases;
}

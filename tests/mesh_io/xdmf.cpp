// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/says.h"
#include "support/scratch_folder.h"
#include "support/text_format.h"

using trismooth::FileFormat;
using trismooth::MeshDocument;
using trismooth::ReadError;
using trismooth::ScalarType;
using trismooth::WriteError;

namespace trismooth::xdmf_test {
namespace {

const TextFormat xdmf{".xdmf"};

std::string grid(std::string_view content, std::string_view attributes = "") {
  return "<Grid Name=\"m\" " + std::string(attributes) + ">" + std::string(content) + "</Grid>";
}

std::string file(std::string_view grids, std::string_view head = "") {
  return std::string(head) + "<Xdmf Version=\"3.0\"><Domain>" + std::string(grids) + "</Domain></Xdmf>";
}

std::string topology(std::string_view type, std::string_view extents, std::string_view numbers,
                     std::string_view more = "") {
  return "<Topology TopologyType=\"" + std::string(type) + "\" " + std::string(more) +
         "><DataItem NumberType=\"Int\" Dimensions=\"" + std::string(extents) + "\">" + std::string(numbers) +
         "</DataItem></Topology>";
}

std::string points(std::string_view numbers = "0 0 1 0 1 1 0 1", std::string_view extents = "4 2",
                   std::string_view type = "XY") {
  return "<Geometry GeometryType=\"" + std::string(type) + "\"><DataItem Precision=\"8\" Dimensions=\"" +
         std::string(extents) + "\">" + std::string(numbers) + "</DataItem></Geometry>";
}

std::string attribute(std::string_view name, std::string_view center, std::string_view extents,
                      std::string_view numbers) {
  return "<Attribute Name=\"" + std::string(name) + "\" Center=\"" + std::string(center) +
         "\"><DataItem NumberType=\"Int\" Dimensions=\"" + std::string(extents) + "\">" + std::string(numbers) +
         "</DataItem></Attribute>";
}

const std::string two_triangles = topology("Triangle", "2 3", "0 1 2 0 2 3");
const std::string include_points = "<xi:include xpointer=\"xpointer(/Xdmf/Domain/Grid[1]/Geometry)\"/>";

std::string failure(const std::string& text) {
  return xdmf.failure_of(text);
}

/// The file of that extension that the document is written to.
std::string text_of(const MeshDocument& document, const std::string& extension) {
  return TextFormat(extension).written(document);
}

}  // namespace

TEST_CASE("XDMF: cells of each type have the vertices and the type of VTK") {
  const auto cells = [](std::string_view type, std::string_view extents, std::string_view more = "") {
    return xdmf
        .read(file(grid(topology(type, extents, "0 1 2 3 4 5 6 7 8", more) +
                        points("0 0 1 0 2 0 0 1 1 1 2 1 0 2 1 2 2 2", "9 2"))))
        .cells;
  };
  CHECK(cells("Quadrilateral_9", "1 9").types == std::vector<std::uint8_t>{cell_type::biquadratic_quad});
  CHECK(cells("quad_9", "9").types == std::vector<std::uint8_t>{cell_type::biquadratic_quad});
  CHECK(cells("TRIANGLE", "3 3").types == std::vector<std::uint8_t>(3, cell_type::triangle));
  CHECK(cells("Edge_3", "3 3").types == std::vector<std::uint8_t>(3, cell_type::quadratic_edge));
  CHECK(cells("Polyvertex", "9").types == std::vector<std::uint8_t>(9, cell_type::vertex));
  CHECK(cells("Polyline", "3 3", "NodesPerElement=\"3\"").types == std::vector<std::uint8_t>(3, cell_type::poly_line));
  const CellList polygon = cells("Polygon", "1 9", "NodesPerElement=\"9\"");
  CHECK(polygon.types == std::vector<std::uint8_t>{cell_type::polygon});
  CHECK(polygon.connectivity == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("XDMF: tags of the same cells in another order are arrays of these, and sides are added") {
  const MeshDocument document = xdmf.read(
      file(grid(two_triangles + points()) +
           grid(include_points + topology("Triangle", "1 3", "3 0 2") + attribute("cell_tags", "Cell", "1", "5")) +
           grid(include_points + topology("Polyline", "2 2", "0 1 2 1", "NodesPerElement=\"2\"") +
                attribute("facet_tags", "Cell", "2 1", "7 8")) +
           grid(include_points + topology("Polyline", "1 2", "1 2", "NodesPerElement=\"2\"") +
                attribute("facet_tags", "Cell", "1", "9") + attribute("other", "Cell", "1", "1"))));
  CHECK(document.point_count() == 4);
  CHECK(document.cells.types ==
        std::vector<std::uint8_t>{cell_type::triangle, cell_type::triangle, cell_type::line, cell_type::line});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2, 1});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "cell_tags") == std::vector<std::int32_t>{0, 5, 0, 0});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "facet_tags") == std::vector<std::int32_t>{0, 0, 7, 9});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "other") == std::vector<std::int32_t>{0, 0, 0, 1});
}

TEST_CASE("XDMF: tags of faces and of sides are groups of both in other formats, and untagged sides are in none") {
  const MeshDocument document = xdmf.read(file(
      grid(two_triangles + points()) +
      grid(include_points + topology("Triangle", "2 3", "0 1 2 0 2 3") + attribute("material", "Cell", "2", "3 9")) +
      grid(include_points + topology("Polyline", "2 2", "0 1 2 1", "NodesPerElement=\"2\"") +
           attribute("bottom", "Cell", "2", "3 0"))));
  const std::string su2 = text_of(document, ".su2");
  CHECK(su2.substr(su2.find("NMARK")) ==
        "NMARK= 2\nMARKER_TAG= bottom_3\nMARKER_ELEMS= 1\n3 0 1\nMARKER_TAG= boundary\nMARKER_ELEMS= 3\n3 2 1\n3 2 3\n"
        "3 3 0\n");
  for (const char* const extension : {".inp", ".unv", ".msh", ".exo"}) {
    INFO(extension);
    const std::string text = text_of(document, extension);
    for (const char* const name : {"material_3", "material_9", "bottom_3"}) {
      CHECK(text.find(name) != std::string::npos);
    }
    CHECK(text.find("_0") == std::string::npos);
  }
  for (const FileFormat format : {FileFormat::med, FileFormat::cgns, FileFormat::exodus}) {
    if (is_available(format)) {
      const std::vector<std::string> lost = what_is_lost(document, format);
      CHECK(std::ranges::none_of(lost, [](const std::string& loss) { return loss.find("bottom") != loss.npos; }));
    }
  }
}

TEST_CASE("XDMF: whole numbers of cells in the text that tell no type are tags, which a note says") {
  const auto untyped = [](std::string text) {
    return text.erase(text.find(" NumberType"), std::string_view(" NumberType=\"Int\"").size());
  };
  const MeshDocument document = xdmf.read(
      file(grid(two_triangles + points() + untyped(attribute("tags", "Cell", "2 1", "7 9")) +
                untyped(attribute("heat", "Cell", "2 1", "7 9.5")) + untyped(attribute("u", "Node", "4", "1 2 3 4")))));
  CHECK(values_of<std::int32_t>(document.cell_arrays, "tags") == std::vector<std::int32_t>{7, 9});
  CHECK(values_of<double>(document.cell_arrays, "heat") == std::vector<double>{7, 9.5});
  CHECK(values_of<double>(document.point_arrays, "u") == std::vector<double>{1, 2, 3, 4});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "are read as whole ones, as tags are: tags; NumberType=\"Float\" in the file"));
}

TEST_CASE("XDMF: grids with points of their own are one mesh, and a note says so") {
  const std::string triangle = topology("Triangle", "1 3", "0 1 2");
  const MeshDocument document =
      xdmf.read(file(grid(grid(triangle + points("0 0 1 0 1 1", "3 2") + attribute("a", "Node", "3", "1 2 3")) +
                              grid(triangle + points("5 0 6 0 6 1", "3 2") + attribute("a", "Node", "3", "4 5 6")),
                          R"(GridType="Collection" CollectionType="Spatial")")));
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5});
  CHECK(values_of<std::int32_t>(document.point_arrays, "a") == std::vector<std::int32_t>{1, 2, 3, 4, 5, 6});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "2 grids with points of their own"));
}

TEST_CASE("XDMF: of time steps the last is read, which a note says, and points that move are refused") {
  const auto steps = [](const std::string& second) {
    const std::string first = two_triangles + points() + attribute("u", "Node", "4", "1 2 3 4");
    return file(grid(grid(first + attribute("material", "Cell", "2", "5 6")) + grid(second + "<Time Value=\"0.5\"/>"),
                     R"(GridType="Collection" CollectionType="Temporal")"));
  };
  // Each step may have the numbers once more: both are written back.
  const std::string again = steps(two_triangles + points("0 0 1 0 1 1 0 1.0") + attribute("u", "Node", "4", "9 9 9 9"));
  MeshDocument document = xdmf.read(again);
  CHECK(values_of<std::int32_t>(document.point_arrays, "u") == std::vector<std::int32_t>{9, 9, 9, 9});
  CHECK(document.point_arrays.size() == 1);
  // What the first step alone has.
  CHECK(values_of<std::int32_t>(document.cell_arrays, "material") == std::vector<std::int32_t>{5, 6});
  CHECK(document.notes == std::vector<std::string>{
                              "Values are those of the last of 2 time steps, t = 0.5 (for another one, write it to a "
                              "file of its own); XDMF output keeps those of all steps as they were read."});
  CHECK(xdmf.written(document) == again);
  document.points[10] = 0.75;
  const std::string written = xdmf.written(document);
  CHECK(says(written, "0 0 1 0 1 1 0 0.75</DataItem>"));
  CHECK(written.find("0 0.75", written.find("0 0.75") + 1) != std::string::npos);
  CHECK(says(failure(steps(two_triangles + points("0 0 1 0 1 1 0 2"))), "other points than the first one"));
  CHECK(says(failure(steps(topology("Triangle", "1 3", "0 1 2") + points())), "other cells than the first one"));
}

TEST_CASE("XDMF: text is written back byte by byte but for coordinates that differ, in each form of a geometry") {
  for (const std::string& geometry :
       {points(), points("0 0 0 1 0 0 1 1 0 0 1 0", "4 3", "XYZ"),
        std::string("<Geometry GeometryType=\"X_Y\"><DataItem Precision=\"8\" Dimensions=\"4\">0 1 1 0</DataItem>"
                    "<DataItem Precision=\"8\" Dimensions=\"4\">0\n0 1 1</DataItem></Geometry>")}) {
    const std::string text = file(grid(two_triangles + geometry), "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n");
    CAPTURE(text);
    MeshDocument document = xdmf.read(text);
    CHECK(xdmf.written(document) == text);
    document.points[3] = 1.25;
    std::string expected = text;
    expected.replace(expected.find('1', expected.find("Geometry") + 60), 1, "1.25");
    const std::string written = xdmf.written(document);
    CHECK(written.size() == text.size() + 3);
    CHECK(xdmf.read(written).points == document.points);
  }
}

TEST_CASE("XDMF: grids that share the numbers of one axis are read, and refused where they are to be written back") {
  const auto split = [](const std::string& x) {
    return "<Geometry GeometryType=\"X_Y\">" + x + "<DataItem Dimensions=\"4\">0 0 1 1</DataItem></Geometry>";
  };
  const std::string first = grid(two_triangles + split("<DataItem Dimensions=\"4\">0 1 1 0</DataItem>"));
  const std::string second =
      grid(two_triangles + split("<DataItem Reference=\"/Xdmf/Domain/Grid/Grid[1]/Geometry/DataItem[1]\"/>"));
  const MeshDocument document = xdmf.read(file(grid(first + second, "GridType=\"Collection\"")));
  CHECK(document.points == xdmf.read(file(grid(first + first, "GridType=\"Collection\""))).points);
  CHECK(says(message_of<WriteError>([&] { xdmf.written(document); }), "coordinates of several grids overlap"));
}

TEST_CASE("XDMF: text that tells no precision keeps all digits of what is written back") {
  const std::string text = file(
      grid(two_triangles + "<Geometry GeometryType=\"XY\"><DataItem Dimensions=\"4 2\">0.1234567890123456 0 1 0 1 1 "
                           "0 1</DataItem></Geometry>"));
  MeshDocument document = xdmf.read(text);
  CHECK(document.points[0] == 0.1234567890123456);
  document.points[3] = 1.0 / 3;
  CHECK(xdmf.read(xdmf.written(document)).points == document.points);
}

TEST_CASE("XDMF: sets of points and cells come by their names") {
  const auto set = [](std::string_view type, std::string_view members) {
    return "<Set Name=\"s\" SetType=\"" + std::string(type) + "\"><DataItem NumberType=\"Int\" Dimensions=\"2\">" +
           std::string(members) + "</DataItem></Set>";
  };
  const MeshDocument document =
      xdmf.read(file(grid(two_triangles + points() + set("Node", "3 0") + set("Cell", "1 0"))));
  CHECK(document.point_sets == std::vector<NamedSet>{{"s", {3, 0}}});
  CHECK(document.cell_sets == std::vector<NamedSet>{{"s", {1, 0}}});
  CHECK(says(failure(file(grid(two_triangles + points() + set("Node", "0 4")))), "has the member 4"));
}

TEST_CASE("XDMF: an array without a name is called as VTK calls it") {
  const MeshDocument document = xdmf.read(file(grid(two_triangles + points() + attribute("", "Cell", "2", "5 6"))));
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].name == "unnamed");
}

TEST_CASE("XDMF: what breaks the rules is refused with the line and what is wrong") {
  const auto refused = [](const std::string& text, std::string_view what) {
    const std::string message = failure(text);
    CAPTURE(message);
    CHECK(says(message, std::string(what)));
  };
  refused("<Xdmf/>", "has no <Domain>");
  refused("<Xdmf><Domain/></Xdmf>", "has no <Grid>");
  refused(file(grid(points())), "has no <Topology>");
  refused(file(grid(two_triangles)), "has no <Geometry>");
  refused(file(grid(two_triangles + points() + points())), "a second <Geometry>");
  refused(file(grid(topology("Triangle", "2 3", "0 1 2 0 2 4") + points())), "the vertex 4, and there are 4 points");
  refused(file(grid(topology("Triangle", "2 3", "0 1 2 0 2 -1") + points())), "the vertex -1");
  refused(file(grid(topology("Triangle", "2 3", "0 1 2 0 2") + points())),
          "declares 6 numbers in a <DataItem>, but the file has room for 5");
  refused(file(grid(topology("Triangle", "2 3", "0 1 2 0 2 3 1") + points())), "expected the end of a <DataItem>");
  refused(file(grid(topology("Triangle", "5", "0 1 2 0 2") + points())), "no cells of 3 vertices each");
  refused(file(grid(topology("Triangle", "2 3", "0 1 2 0 2 3", "NumberOfElements=\"3\"") + points())),
          "NumberOfElements='3', but there are 2 cells");
  refused(file(grid(topology("Triangle", "2000000000 1000000000", "0 1 2") + points())), "numbers in a <DataItem>");
  refused(file(grid(topology("Mixed", "5", "4 0 1 2 99") + points())), "of the type 99");
  refused(file(grid(topology("Mixed", "3", "4 0 1") + points())), "has 3 vertices, and 2 numbers are left");
  refused(file(grid(topology("Mixed", "2", "2 -5") + points())), "has 0 vertices");
  refused(file(grid("<Topology TopologyType=\"2DCoRectMesh\" Dimensions=\"3 3\"/>" + points())), "a structured grid");
  refused(file(grid(two_triangles + points("0 0 1 0 1 1 0 nan"))), "is not finite");
  refused(file(grid(two_triangles + points("0 0 1 0 1 1 0 x"))), "expected a number, got 'x'");
  refused(file(grid(two_triangles + points("0 0 1 0 1 1 0", "7"))), "not those of whole points");
  refused(file(grid(two_triangles + points("0", "1", "VXVYVZ"))), "the geometry 'VXVYVZ' is not read");
  refused(file(grid("<xi:include href=\"other.xdmf\"/>")), "includes another file");
  refused(file(grid("<xi:include xpointer=\"xpointer(//Nothing)\"/>")), "leads to nothing");
  refused(file(grid("<xi:include xpointer=\"xpointer(count(/))\"/>")), "is none that is read");
  // A grid that includes itself.
  refused(file(grid("<xi:include xpointer=\"xpointer(//Grid)\"/>", R"(GridType="Tree")")), "nested too deeply");
  refused("<!DOCTYPE Xdmf [<!ENTITY a \"aaaa\">]><Xdmf>&a;</Xdmf>", "entities of the file's own are not accepted");
}

TEST_CASE("XDMF: only files beside the file are read") {
  const auto with = [](std::string_view name) {
    return file(grid(two_triangles + "<Geometry><DataItem Dimensions=\"4 3\" Format=\"HDF\">" + std::string(name) +
                     ":/points</DataItem></Geometry>"));
  };
  for (const char* const name : {"/etc/passwd", "../a.h5", "b/a.h5", "..", "b\\a.h5"}) {
    CHECK(says(failure(with(name)), "only files beside this one are read"));
  }
  CHECK(says(failure(with("none.h5")), "none.h5, which is not beside it"));
  CHECK(says(
      message_of<ReadError>([&] { codec_of(FileFormat::xdmf).read("standard input", FileBytes(with("none.h5"))); }),
      "standard input:1: its numbers are in none.h5, which is not in the current folder"));
}

TEST_CASE("XDMF: numbers in a binary file beside it are read in either order of bytes, and led along") {
  const ScratchFolder folder;
  const std::string bytes(
      "head\x00\x00\x00\x00\x3f\x80\x00\x00\x3f\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x3f\x80\x00\x00", 28);
  folder.write("in0.bin", bytes);
  const std::filesystem::path in =
      folder.write("in.xdmf", file(grid(topology("Triangle", "1 3", "0 1 2") +
                                        "<Geometry GeometryType=\"XY\"><DataItem Dimensions=\"3 2\" Format=\"Binary\" "
                                        "Precision=\"4\" Endian=\"Big\" Seek=\"4\"> in0.bin\n</DataItem></Geometry>")));
  MeshDocument document = read_mesh(in);
  CHECK(document.points == std::vector<double>{0, 1, 0, 0.5, 0, 0, 0, 1, 0});
  CHECK(document.point_type == ScalarType::float32);
  document.points[0] = 1;
  write_mesh(folder / "out.xdmf", document);
  std::string expected = bytes;
  expected.replace(4, 4, std::string("\x3f\x80\x00\x00", 4));
  CHECK(bytes_of(folder / "out0.bin") == expected);
  CHECK(says(bytes_of(folder / "out.xdmf"), "> out0.bin\n<"));
  CHECK(read_mesh(folder / "out.xdmf").points == document.points);
  folder.write("in0.bin", bytes.substr(0, 27));
  CHECK_THROWS_AS(read_mesh(in), ReadError);
}

TEST_CASE("XDMF: files that are led along to another folder replace nothing that has their names there") {
  const ScratchFolder from;
  from.write("notes.txt", std::string(16, '\0'));
  const std::filesystem::path in = from.write(
      "in.xdmf", file(grid(two_triangles + points() +
                           "<Attribute Name=\"a\" Center=\"Node\"><DataItem Format=\"Binary\" Endian=\"Little\" "
                           "Dimensions=\"4\">notes.txt</DataItem></Attribute>")));
  const MeshDocument document = read_mesh(in);
  for (const std::string& name : {std::string("out"), std::string("in")}) {
    CAPTURE(name);
    const ScratchFolder to;
    to.write("notes.txt", "mine");
    write_mesh(to / (name + ".xdmf"), document);
    CHECK(bytes_of(to / "notes.txt") == "mine");
    CHECK(bytes_of(to / (name + "_notes.txt")) == std::string(16, '\0'));
    CHECK(says(bytes_of(to / (name + ".xdmf")), ">" + name + "_notes.txt<"));
    CHECK(values_of<float>(read_mesh(to / (name + ".xdmf")).point_arrays, "a") == std::vector<float>(4));
  }
}

TEST_CASE("XDMF: what is written from another format reads back the same, and both files appear or none") {
  MeshDocument document;
  document.format = FileFormat::vtu;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 2, 3});
  document.point_arrays.push_back(make_data_array("a < \"b\"", 2, std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8.5F}));
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<std::uint8_t>{1, 2, 255}));
  const ScratchFolder folder;
  write_mesh(folder / "out.xdmf", document);
  for (const std::string& name : {std::string("out.xdmf"), std::string("out.xdmf.gz")}) {
    CAPTURE(name);
    write_mesh(folder / name, document);
    const MeshDocument read = read_mesh(folder / name);
    CHECK(read.points == document.points);
    CHECK(read.cells.types == document.cells.types);
    CHECK(read.cells.connectivity == document.cells.connectivity);
    CHECK(values_of<float>(read.point_arrays, "a < \"b\"") == std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8.5F});
    CHECK(values_of<std::uint8_t>(read.cell_arrays, "region") == std::vector<std::uint8_t>{1, 2, 255});
  }
  if (codec_of(FileFormat::xdmf).other_files_of("out.xdmf").empty()) {
    return;  // a build without HDF5
  }
  CHECK(std::filesystem::exists(folder / "out.h5"));
  const ScratchFolder other;
  std::filesystem::create_directory(other / "out.h5");
  CHECK_THROWS_AS(write_mesh(other / "out.xdmf", document), WriteError);
  CHECK(other.size() == 1);
}

TEST_CASE("XDMF: names of values and sets that come from another format read back the same") {
  MeshDocument document;
  document.format = FileFormat::msh;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::vertex, std::vector<std::int32_t>{3});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 2, 3});
  DataArray groups = make_data_array("group", 1, std::vector<std::int32_t>{2, 7, 7, -9});
  ArrayDescription names;
  names.value_names = {{2, 0, "pin"}, {7, 1, "wall <]]> & \"more\""}, {-9, 2, "copper"}, {7, 2, "steel"}};
  groups.description = std::make_shared<const ArrayDescription>(names);
  document.cell_arrays.push_back(groups);
  document.point_arrays.push_back(make_data_array("sensors", 1, std::vector<double>{1, 2, 3, 4}));
  document.point_sets = {{"sensors", {0, 3}}, {"none", {}}, {"all", {0, 1, 2, 3}}};
  document.cell_sets = {{"group", {3}}, {"core", {2, 3}}};
  const ScratchFolder folder;
  for (const std::string& name : {std::string("out.xdmf"), std::string("out.xdmf.gz")}) {
    CAPTURE(name);
    write_mesh(folder / name, document);
    const MeshDocument read = read_mesh(folder / name);
    CHECK(read.point_sets == document.point_sets);
    CHECK(read.cell_sets == document.cell_sets);
    REQUIRE(read.cell_arrays.size() == 1);
    CHECK(values_of<std::int32_t>(read.cell_arrays, "group") == std::vector<std::int32_t>{2, 7, 7, -9});
    REQUIRE(read.cell_arrays[0].description != nullptr);
    CHECK(std::ranges::is_permutation(read.cell_arrays[0].description->value_names, names.value_names));
    REQUIRE(read.point_arrays.size() == 1);
    CHECK(values_of<double>(read.point_arrays, "sensors") == std::vector<double>{1, 2, 3, 4});
  }
}

TEST_CASE("XDMF: an <Information> of any kind is left alone") {
  const std::string array = attribute("group", "Cell", "2", "1 2");
  for (const std::string_view content :
       {"<![CDATA[<main><map key=\"a\" dim=\"2\" array=\"group\">1]]>",
        "<![CDATA[<main><map key=\"a\" dim=\"2\">1</map></main>]]>",
        "<![CDATA[<main><map key=\"a\" dim=\"9\" array=\"group\">1</map></main>]]>", "made by hand", ""}) {
    CAPTURE(content);
    const std::string text = file(
        grid(two_triangles + points() + array + "<Information Name=\"x\">" + std::string(content) + "</Information>"));
    const MeshDocument document = xdmf.read(text);
    REQUIRE(document.cell_arrays.size() == 1);
    CHECK((document.cell_arrays[0].description == nullptr || document.cell_arrays[0].description->value_names.empty()));
    CHECK(xdmf.written(document) == text);
  }
}

TEST_CASE("XDMF: the HDF5 file beside it is led along and changes in coordinates alone") {
  MeshDocument document;
  document.format = FileFormat::vtu;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  const ScratchFolder folder;
  write_mesh(folder / "in.xdmf", document);
  if (!std::filesystem::exists(folder / "in.h5")) {
    return;  // a build without HDF5
  }
  MeshDocument read = read_mesh(folder / "in.xdmf");
  write_mesh(folder / "same.xdmf", read);
  CHECK(bytes_of(folder / "same.h5") == bytes_of(folder / "in.h5"));
  CHECK(says(bytes_of(folder / "same.xdmf"), ">same.h5:/geometry<"));
  read.points[10] = 2;
  write_mesh(folder / "moved.xdmf", read);
  const std::string before = bytes_of(folder / "in.h5");
  const std::string after = bytes_of(folder / "moved.h5");
  REQUIRE(after.size() == before.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    different += before[i] == after[i] ? 0 : 1;
  }
  CHECK(different > 0);
  CHECK(different <= 8);
  CHECK(read_mesh(folder / "moved.xdmf").points == read.points);
  // In place, and the one file without the other.
  write_mesh(folder / "in.xdmf", read);
  CHECK(bytes_of(folder / "in.h5") == after);
  std::filesystem::remove(folder / "in.h5");
  CHECK(says(message_of<ReadError>([&] { read_mesh(folder / "in.xdmf"); }), "in.h5, which is not beside it"));
}

}  // namespace trismooth::xdmf_test

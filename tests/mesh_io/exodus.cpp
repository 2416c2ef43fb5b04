// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/netcdf_builder.h"
#include "support/says.h"
#include "support/text_format.h"

namespace trismooth::exodus_test {

using test_support::NetcdfBuilder;

const TextFormat exodus(".exo");

constexpr auto int32 = NetcdfBuilder::int32;
constexpr auto float64 = NetcdfBuilder::float64;

/// Two squares side by side, of which the right one is two triangles: nodes 0 to 5, x to the right, three below.
struct Plate {
  NetcdfBuilder file{2};
  int nodes = 0;
  int length = 0;

  explicit Plate(std::size_t axes = 2, const std::string& triangles = "TRI3", std::size_t steps = 0) {
    length = file.dimension("len_name", 12);
    file.dimension("num_dim", axes);
    if (steps > 0) {
      file.dimension("time_step", 0, steps);
    }
    nodes = file.dimension("num_nodes", 6);
    file.variable("coordx", float64, {nodes}, {0, 1, 2, 0, 1, 2});
    file.variable("coordy", float64, {nodes}, {0, 0, 0, 1, 1, 1});
    if (axes == 3) {
      file.variable("coordz", float64, {nodes}, {0, 0, 0, 0, 0, 0});
    }
    block(1, "QUAD4", 4, {1, 2, 5, 4});
    block(2, triangles, 3, {2, 3, 6, 2, 6, 5});
  }

  void block(int number, const std::string& type, std::size_t each, const std::vector<double>& connect) {
    const std::string suffix = std::to_string(number);
    const int elements = file.dimension("num_el_in_blk" + suffix, connect.size() / each);
    const int of_each = file.dimension("num_nod_per_el" + suffix, each);
    file.variable("connect" + suffix, int32, {elements, of_each}, connect, {{"elem_type", type}});
  }

  void list(const std::string& name, const std::vector<double>& values) {
    file.variable(name, int32, {file.dimension("of_" + name, values.size())}, values);
  }

  void names(const std::string& name, const std::vector<std::string>& texts) {
    file.texts(name, {file.dimension("of_" + name, texts.size()), length}, texts);
  }

  void side_set(int number, const std::vector<double>& elements, const std::vector<double>& sides) {
    list("elem_ss" + std::to_string(number), elements);
    list("side_ss" + std::to_string(number), sides);
  }
};

std::vector<std::int32_t> cell(const MeshDocument& document, std::size_t i) {
  const auto vertices = document.cells[i];
  return {vertices.begin(), vertices.end()};
}

TEST_CASE("Exodus: blocks, side sets and node sets become regions, lines and sets by their names") {
  Plate plate;
  plate.list("eb_prop1", {30, 10});
  plate.names("eb_names", {"left", ""});
  plate.side_set(1, {1, 2}, {1, 1});
  plate.side_set(2, {3}, {2});
  plate.list("ss_prop1", {7, 8});
  plate.names("ss_names", {"floor", ""});
  plate.list("node_ns1", {4, 1});
  plate.list("ns_prop1", {5});
  const MeshDocument document = exodus.read(plate.file.bytes());
  CHECK(document.cells.types == std::vector<std::uint8_t>{9, 5, 5, 3, 3, 3});
  CHECK(cell(document, 3) == std::vector<std::int32_t>{0, 1});
  CHECK(cell(document, 4) == std::vector<std::int32_t>{1, 2});
  CHECK(cell(document, 5) == std::vector<std::int32_t>{5, 4});
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].name == "exodus:block");
  CHECK(values_of<std::int64_t>(document.cell_arrays, "exodus:block") ==
        std::vector<std::int64_t>{30, 10, 10, 7, 7, 8});
  CHECK(document.cell_arrays[0].description->value_names ==
        std::vector<ValueName>{{30, 2, "left"}, {7, 1, "floor"}, {8, 1, "side set 8"}});
  CHECK(document.point_sets == std::vector<NamedSet>{{"node set 5", {3, 0}}});
  CHECK(document.cell_sets.empty());
  CHECK(document.first_point_label == 1);
}

TEST_CASE("Exodus: an edge that two side sets have, or two elements, is one line, and the larger set a set of cells") {
  Plate plate;
  // The edge between the squares from both, and all that is below.
  plate.side_set(1, {1, 3}, {2, 3});
  plate.side_set(2, {1, 2, 1}, {1, 1, 2});
  const MeshDocument document = exodus.read(plate.file.bytes());
  CHECK(document.cells.size() == 6);
  CHECK(cell(document, 3) == std::vector<std::int32_t>{1, 4});
  CHECK(document.cell_sets == std::vector<NamedSet>{{"side set 2", {3, 4, 5}}});
}

TEST_CASE("Exodus: the first two sides of a shell in space are its faces") {
  Plate plate(3, "TRISHELL3");
  plate.side_set(1, {2, 3}, {1, 2});  // faces
  plate.side_set(2, {2, 3}, {3, 5});  // the first and the third edge
  const MeshDocument document = exodus.read(plate.file.bytes());
  CHECK(document.cell_sets == std::vector<NamedSet>{{"side set 1", {1, 2}}});
  REQUIRE(document.cells.size() == 5);
  CHECK(cell(document, 3) == std::vector<std::int32_t>{1, 2});
  CHECK(cell(document, 4) == std::vector<std::int32_t>{4, 1});
  // Where sides 1 to 3 occur together they are edges.
  Plate edges(3, "TRI3");
  edges.side_set(1, {2, 3, 3}, {1, 2, 3});
  const MeshDocument lines = exodus.read(edges.file.bytes());
  CHECK(lines.cell_sets.empty());
  REQUIRE(lines.cells.size() == 6);
  CHECK(cell(lines, 4) == std::vector<std::int32_t>{5, 4});
}

TEST_CASE("Exodus: ids of nodes are their labels, and element sets sets of cells") {
  Plate plate;
  plate.list("node_num_map", {10, 20, 30, 40, 50, 60});
  plate.list("elem_els1", {3, 1});
  plate.names("els_names", {"chosen"});
  const MeshDocument document = exodus.read(plate.file.bytes());
  CHECK(document.point_labels == std::vector<std::int64_t>{10, 20, 30, 40, 50, 60});
  CHECK(document.cell_sets == std::vector<NamedSet>{{"chosen", {2, 0}}});
}

TEST_CASE("Exodus: elements that are not known hold their nodes, and a note names them") {
  Plate plate;
  plate.block(3, "SPLINE", 2, {1, 3});
  plate.block(4, "BAR2", 2, {1, 2});
  plate.block(5, "SPHERE", 1, {6});
  plate.names("eb_names", {"left", "right"});
  const MeshDocument document = exodus.read(plate.file.bytes());
  CHECK(document.cells.types == std::vector<std::uint8_t>{9, 5, 5, 2, 3, 1});
  CHECK(document.notes ==
        std::vector<std::string>{"Elements of types that are not known hold their nodes: 'SPLINE' with 2 nodes."});
}

/// A plate of so many steps, with values of nodes and of the triangles.
std::string with_values(std::size_t steps, const std::string& name) {
  Plate plate(2, "TRI3", steps);
  plate.names("eb_names", {"left", "right"});
  plate.names("name_nod_var", {name});
  plate.names("name_elem_var", {"flux"});
  std::vector<double> times;
  std::vector<double> at_nodes;
  std::vector<double> at_elements;
  for (std::size_t step = 0; step < steps; ++step) {
    times.push_back(0.5 * static_cast<double>(step));
    for (int node = 0; node < 6; ++node) {
      at_nodes.push_back(static_cast<double>(10 * step) + node);
    }
    at_elements.insert(at_elements.end(), {1.0 + static_cast<double>(step), 2.0});
  }
  const int step = 2;
  const int two = plate.file.dimension("two", 2);
  plate.file.variable("time_whole", float64, {step}, times);
  plate.file.variable("vals_nod_var1", float64, {step, plate.nodes}, at_nodes);
  plate.file.variable("vals_elem_var1eb2", float64, {step, two}, at_elements);
  return plate.file.bytes();
}

TEST_CASE(
    "Exodus: values are those of the last step, which a note says, and are written back where there is one step") {
  const MeshDocument document = exodus.read(with_values(3, "disp_x"));
  CHECK(values_of<double>(document.point_arrays, "disp_x") == std::vector<double>{20, 21, 22, 23, 24, 25});
  const std::vector<double> flux = values_of<double>(document.cell_arrays, "flux");
  REQUIRE(flux.size() == 3);
  CHECK(std::isnan(flux[0]));
  CHECK(flux[1] == 3);
  REQUIRE(document.notes.size() == 2);
  CHECK(document.notes[0] ==
        "Values at nodes and elements are those of the last of 3 time steps, t = 1 (for another one, write it to a "
        "file of its own); Exodus output keeps those of all steps as they were read.");
  CHECK(document.notes[1] == "The mesh is the one without displacements, which are values at nodes: disp_x.");
  CHECK_FALSE(writes_values_of(document, FileFormat::exodus, "disp_x"));

  const std::string one = with_values(1, "heat");
  MeshDocument changed = exodus.read(one);
  CHECK(changed.notes.empty());
  CHECK(writes_values_of(changed, FileFormat::exodus, "heat"));
  CHECK(exodus.written(changed) == one);
  changed.point_arrays[0] = make_data_array("heat", 1, std::vector<double>{0, 1, 2.5, 3, 4, 5});
  const MeshDocument again = exodus.read(exodus.written(changed));
  CHECK(values_of<double>(again.point_arrays, "heat") == std::vector<double>{0, 1, 2.5, 3, 4, 5});
  CHECK(again.points == changed.points);
}

TEST_CASE("Exodus: what is wrong is named, with its block, set or node") {
  CHECK(exodus.failure_of(NetcdfBuilder(2).bytes()) ==
        "mesh.exo: is NetCDF without a mesh of Exodus II or UGRID, which is not read; known are " + format_names());
  const auto failure = [](const auto& add) {
    Plate plate;
    add(plate);
    return exodus.failure_of(plate.file.bytes());
  };
  CHECK(failure([](Plate& plate) {
          plate.block(3, "TRI3", 3, {1, 2, 7});
        }) == "mesh.exo: element block 3 names node 7, of 6, in its element 1");
  CHECK(failure([](Plate& plate) {
          plate.block(3, "TRI3", 3, {1, 2, 0});
        }) == "mesh.exo: element block 3 names node 0, of 6, in its element 1");
  CHECK(failure([](Plate& plate) { plate.side_set(2, {4}, {1}); }) == "mesh.exo: side set 2 names element 4, of 3");
  CHECK(failure([](Plate& plate) { plate.side_set(1, {2}, {4}); }) ==
        "mesh.exo: 'side set 1' names side 4 of element 2, which it has not");
  CHECK(failure([](Plate& plate) {
          plate.side_set(1, {1, 2}, {1});
        }) == "mesh.exo: side set 1 has not as many sides as elements");
  CHECK(failure([](Plate& plate) { plate.list("node_ns3", {-1}); }) == "mesh.exo: node set 3 names node -1, of 6");
  NetcdfBuilder infinite(2);
  infinite.dimension("num_dim", 2);
  const int nodes = infinite.dimension("num_nodes", 2);
  infinite.variable("coordx", float64, {nodes}, {0, HUGE_VAL});
  infinite.variable("coordy", float64, {nodes}, {0, 0});
  CHECK(exodus.failure_of(infinite.bytes()) == "mesh.exo: node 2 has a coordinate that is no finite number");
  NetcdfBuilder line(2);
  line.dimension("num_dim", 1);
  line.dimension("num_nodes", 2);
  CHECK(exodus.failure_of(line.bytes()) == "mesh.exo: has nodes of 1 coordinates; expected 2 or 3");
}

TEST_CASE("Exodus: a small file that declares a large mesh is refused before memory is taken") {
  NetcdfBuilder file(5);
  file.dimension("num_dim", 2);
  const int nodes = file.dimension("num_nodes", std::size_t{1} << 30);
  file.variable("coordx", float64, {nodes}, {0, 1});
  file.variable("coordy", float64, {nodes}, {0, 1});
  CHECK(says(exodus.failure_of(file.bytes()), "is cut off or damaged: the values of 'coordx' are not all in the file"));
}

/// Two regions, lines of two groups around, sets.
MeshDocument document_of_groups() {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
  document.cells.append(cell_type::line, std::vector<std::int32_t>{1, 0});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{1, 2, 5});
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 4, 3});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{1, 5, 4});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{2, 5});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 5});  // a side of none
  DataArray groups = make_data_array("region", 1, std::vector<std::int32_t>{4, 2, 3, 2, 5, 6});
  groups.description = std::make_shared<const ArrayDescription>(
      ArrayDescription{{}, {}, {{2, 2, "air"}, {3, 2, "steel"}, {4, 1, "floor"}, {5, 1, "outlet"}}, {}});
  document.cell_arrays = {groups,
                          make_data_array("load", 2, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})};
  document.point_arrays = {make_data_array("heat", 1, std::vector<float>{0, 1, 2, 3, 4, 5.5F})};
  document.point_sets = {{"corners", {0, 2}}, {"none", {}}};
  document.cell_sets = {{"upper", {3, 2}}, {"around", {0, 4}}};
  return document;
}

TEST_CASE("Exodus: regions are written as blocks, lines of groups as side sets, and come back by their names") {
  const MeshDocument document = document_of_groups();
  const MeshDocument read = exodus.read(exodus.written(document));
  CHECK(read.points == document.points);
  // Blocks by their numbers, faces first; the line that is no side; then the sides.
  CHECK(read.cells.types == std::vector<std::uint8_t>{5, 5, 9, 3, 3, 3});
  CHECK(values_of<std::int64_t>(read.cell_arrays, "exodus:block") == std::vector<std::int64_t>{2, 2, 3, 6, 4, 5});
  CHECK(read.cell_arrays[0].description->value_names ==
        std::vector<ValueName>{{2, 2, "air"}, {3, 2, "steel"}, {4, 1, "floor"}, {5, 1, "outlet"}});
  CHECK(cell(read, 4) == std::vector<std::int32_t>{0, 1});
  CHECK(values_of<double>(read.point_arrays, "heat") == std::vector<double>{0, 1, 2, 3, 4, 5.5});
  const std::vector<double> load = values_of<double>(read.cell_arrays, "load_y");
  REQUIRE(load.size() == 6);
  CHECK(std::vector(load.begin(), load.begin() + 4) == std::vector<double>{4, 8, 6, 12});
  CHECK(read.point_sets == std::vector<NamedSet>{{"corners", {0, 2}}, {"none", {}}});
  CHECK(read.cell_sets == std::vector<NamedSet>{{"around", {4, 5}}, {"upper", {1, 2}}});
  CHECK(
      what_is_lost(document, FileFormat::exodus) ==
      std::vector<std::string>{
          "Exodus II has boundaries as sides of faces: 2 lines are written in side sets, without values of cell arrays",
          "Exodus II lists cells by block, of a region and a type: they are written in another order, their old "
          "numbers are their labels (elem_num_map)"});
}

TEST_CASE("Exodus: of numbers that change it is said which are those of blocks and which of side sets") {
  MeshDocument document = document_of_groups();
  DataArray groups = make_data_array("region", 1, std::vector<std::int32_t>{-4, -2, 3, -2, 5, 6});
  groups.description = std::make_shared<const ArrayDescription>(ArrayDescription{{}, {}, {{-4, 1, "floor"}}, {}});
  document.cell_arrays = {groups};
  const std::vector<std::string> lost = what_is_lost(document, FileFormat::exodus);
  CHECK(std::ranges::count(lost, "Exodus II numbers blocks from 1 on, each number once: changed are -2 to 1") == 1);
  CHECK(std::ranges::count(
            lost, "Exodus II numbers side sets from 1 on, each number once: changed are -4 (floor) to 1") == 1);
}

TEST_CASE("Exodus: a group of several types is a block of each, and numbers that cannot be ids change: both are told") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0};
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 2, 3});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{1, 4, 2});
  DataArray groups = make_data_array("region", 1, std::vector<std::int32_t>{0, 0});
  groups.description = std::make_shared<const ArrayDescription>(ArrayDescription{{}, {}, {{0, 2, "all"}}, {}});
  document.cell_arrays = {groups};
  const MeshDocument read = exodus.read(exodus.written(document));
  CHECK(values_of<std::int64_t>(read.cell_arrays, "exodus:block") == std::vector<std::int64_t>{1, 1});
  CHECK(values_of<std::int64_t>(read.cell_arrays, "exodus:element_id") == std::vector<std::int64_t>{2, 1});
  CHECK(read.cell_arrays[0].description->value_names == std::vector<ValueName>{{1, 2, "all"}});
  CHECK(read.notes.empty());
  const std::vector<std::string> lost = what_is_lost(document, FileFormat::exodus);
  REQUIRE(lost.size() == 3);
  CHECK(says(lost[1], "changed are 0 (all) to 1"));
  CHECK(says(lost[2], "'region' keeps together: all (1, 2)"));
  // Faces and lines of no group come back as such.
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cell_arrays.clear();
  const MeshDocument plain = exodus.read(exodus.written(document));
  CHECK(plain.cells.size() == 3);
  CHECK(find_array(plain.cell_arrays, "exodus:block") == nullptr);
  CHECK(plain.notes.empty());
  document.cell_arrays = {make_data_array("region", 1, std::vector<std::int32_t>{7, 8, 0})};
  document.cell_arrays[0].description =
      std::make_shared<const ArrayDescription>(ArrayDescription{{}, {}, {{7, 2, "a"}, {8, 2, "b"}}, {}});
  CHECK(values_of<std::int64_t>(exodus.read(exodus.written(document)).cell_arrays, "exodus:block") ==
        std::vector<std::int64_t>{7, 8, 0});
  document.cell_arrays.clear();
  CHECK(what_is_lost(document, FileFormat::exodus).size() == 1);
}

TEST_CASE(
    "Exodus: blocks whose names differ in the type of elements alone are one region, which an array tells apart") {
  Plate plate;
  plate.list("eb_prop1", {30, 10});
  plate.names("eb_names", {"plate", "plate_tri"});
  plate.side_set(1, {1}, {1});
  const MeshDocument document = exodus.read(plate.file.bytes());
  CHECK(values_of<std::int64_t>(document.cell_arrays, "exodus:block") == std::vector<std::int64_t>{30, 30, 30, 1});
  CHECK(document.cell_arrays[0].description->value_names ==
        std::vector<ValueName>{{30, 2, "plate"}, {1, 1, "side set 1"}});
  CHECK(values_of<std::int64_t>(document.cell_arrays, "exodus:typed_block") ==
        std::vector<std::int64_t>{30, 10, 10, 0});
  CHECK(document.notes.empty());
}

TEST_CASE("Exodus: blocks of different types without names are regions, and a note says what frees what is between") {
  const MeshDocument document = exodus.read(Plate().file.bytes());
  CHECK(values_of<std::int64_t>(document.cell_arrays, "exodus:block") == std::vector<std::int64_t>{1, 2, 2});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "if they are one region, --region-array none frees what is between them"));
}

TEST_CASE("Exodus: nodes of curved cells and solids are in their own order, in the file and back") {
  MeshDocument document;
  for (int i = 0; i < 40; ++i) {
    document.points.insert(document.points.end(), {i % 7 + 0.5, i / 7 - 0.25, i % 3 * 0.5});
  }
  const auto add = [&document](std::uint8_t type, std::int32_t first, std::size_t nodes) {
    std::vector<std::int32_t> vertices(nodes);
    for (std::size_t k = 0; k < nodes; ++k) {
      vertices[k] = first + static_cast<std::int32_t>(k);
    }
    document.cells.append(type, vertices);
  };
  add(cell_type::quadratic_triangle, 3, 6);
  add(cell_type::quadratic_quad, 9, 8);
  add(cell_type::biquadratic_quad, 11, 9);
  add(cell_type::quadratic_tetrahedron, 1, 10);
  add(cell_type::quadratic_hexahedron, 2, 20);
  add(cell_type::quadratic_wedge, 4, 15);
  const MeshDocument read = exodus.read(exodus.written(document));
  CHECK(read.points == document.points);
  CHECK(read.cells.types == document.cells.types);
  CHECK(read.cells.connectivity == document.cells.connectivity);
}

}  // namespace trismooth::exodus_test

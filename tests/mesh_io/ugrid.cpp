// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/netcdf_builder.h"
#include "support/says.h"
#include "support/text_format.h"

namespace trismooth::ugrid_test {

using test_support::NetcdfBuilder;
using Attributes = std::vector<NetcdfBuilder::Attribute>;

const TextFormat ugrid(".nc");

constexpr auto int32 = NetcdfBuilder::int32;
constexpr auto float64 = NetcdfBuilder::float64;

/// A square and a triangle.
struct Coast {
  NetcdfBuilder file{2};
  int nodes = 0;
  int faces = 0;

  explicit Coast(Attributes more = {}, const std::string& unit = "m",
                 std::vector<double> table = {0, 1, 2, 3, 1, 4, 2, -1}) {
    Attributes topology{{"cf_role", "mesh_topology"},
                        {"topology_dimension", "", {2}},
                        {"node_coordinates", "lat lon"},
                        {"face_node_connectivity", "face_nodes"}};
    topology.insert(topology.end(), more.begin(), more.end());
    nodes = file.dimension("nodes", 5);
    faces = file.dimension("faces", 2);
    file.variable("mesh", int32, {}, {0}, topology);
    // y first, as its name says.
    file.variable("lat", float64, {nodes}, {50, 50, 51, 51, 50},
                  {{"standard_name", unit == "m" ? "projection_y_coordinate" : "latitude"}});
    file.variable("lon", float64, {nodes}, {3, 4, 4, 3, 5}, {{"units", unit}});
    file.variable("face_nodes", int32, {faces, file.dimension("corners", table.size() / 2)}, table,
                  {{"_FillValue", "", {-1}}});
  }
};

TEST_CASE("UGRID: longitudes are x wherever they stand, and the file says that they are degrees") {
  Coast coast({}, "degrees_east");
  const MeshDocument document = ugrid.read(coast.file.bytes());
  CHECK(document.is_geographic);
  CHECK(std::vector(document.points.begin(), document.points.begin() + 6) == std::vector<double>{3, 50, 0, 4, 50, 0});
  CHECK(document.cells.types == std::vector<std::uint8_t>{9, 5});
  CHECK(document.first_point_label == 0);
  CHECK_FALSE(ugrid.read(Coast().file.bytes()).is_geographic);
}

TEST_CASE("UGRID: real numbers at nodes are of places, and written back with what moved; others stay, with a note") {
  Coast coast(Attributes{{"face_coordinates", "face_x face_y"}});
  coast.file.variable("depth", float64, {coast.nodes}, {1, 2, 3, 4, 5});
  coast.file.variable("zone", int32, {coast.faces}, {7, 8});
  coast.file.variable("level", float64, {coast.file.dimension("layers", 2), coast.nodes},
                      {0, 0, 0, 0, 0, 1, 1, 1, 1, 1});
  coast.file.variable("face_x", float64, {coast.faces}, {3.5, 4.3});
  const std::string bytes = coast.file.bytes();
  MeshDocument document = ugrid.read(bytes);
  CHECK(document.arrays_of_places == std::vector<std::string>{"depth"});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "zone") == std::vector<std::int32_t>{7, 8});
  CHECK(document.notes ==
        std::vector<std::string>{"Places of faces and edges stay in UGRID output as they were read, also where nodes "
                                 "move: face_x, face_y.",
                                 "Values of several times or layers are kept in UGRID output only: level."});
  CHECK(ugrid.written(document) == bytes);
  document.points[3] = 4.25;
  document.point_arrays[0] = make_data_array("depth", 1, std::vector<double>{1, 2.5, 3, 4, 5});
  const std::string moved = ugrid.written(document);
  CHECK(moved.size() == bytes.size());
  const MeshDocument again = ugrid.read(moved);
  CHECK(again.points == document.points);
  CHECK(values_of<double>(again.point_arrays, "depth") == std::vector<double>{1, 2.5, 3, 4, 5});
}

TEST_CASE("UGRID: packed values and those of several times stay in the file, and a note names them") {
  Coast coast;
  const int time = coast.file.dimension("time", 0);
  coast.file.variable("depth", float64, {coast.nodes}, {1, 2, 3, 4, 5}, {{"scale_factor", "", {2}}});
  coast.file.variable("level", float64, {time, coast.nodes}, {1, 2, 3, 4, 5});
  const MeshDocument document = ugrid.read(coast.file.bytes());
  CHECK(document.point_arrays.empty());
  REQUIRE(document.notes.size() == 2);
  CHECK(document.notes[0].find("packed (scale_factor, add_offset) are kept in UGRID output only: depth;") !=
        std::string::npos);
  CHECK(document.notes[1] == "Values of several times or layers are kept in UGRID output only: level.");
}

TEST_CASE("UGRID: what is wrong is named") {
  const auto failure = [](const Coast& coast) { return ugrid.failure_of(coast.file.bytes()); };
  CHECK(failure(Coast({}, "m", {0, 1, 2, 3, 1, 5, 2, -1})) ==
        "mesh.nc: 'face_nodes': row 1 (from 0) names node 5, of 5 from 0");
  CHECK(failure(Coast({}, "m", {0, 1, -1, 3, 1, 4, 2, -1})) ==
        "mesh.nc: 'face_nodes': row 0 (from 0) has a node behind the end of its face");
  CHECK(failure(Coast({}, "m", {0, 1, -1, -1, 1, 4, 2, -1})) ==
        "mesh.nc: 'face_nodes': row 0 (from 0) has fewer than 3 nodes");
  CHECK(failure(Coast(Attributes{{"boundary_node_connectivity", "shore"}})) ==
        "mesh.nc: boundary_node_connectivity 'shore' is no variable of the file");
  NetcdfBuilder line(2);
  line.variable("mesh", int32, {}, {0}, {{"cf_role", "mesh_topology"}, {"topology_dimension", "", {1}}});
  CHECK(ugrid.failure_of(line.bytes()) ==
        "mesh.nc: has a mesh of UGRID, but none of two dimensions (topology_dimension = 2)");
}

TEST_CASE("UGRID: faces, boundary edges and real numbers are written, and come back") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0};
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 2, 3});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{1, 4, 2});
  document.point_arrays = {make_data_array("depth of water", 1, std::vector<double>{1, 2, 3, 4, 5}),
                           make_data_array("wind", 2, std::vector<double>(10))};
  document.cell_arrays = {make_data_array("region", 1, std::vector<std::int32_t>{1, 2, 3})};
  set_unit(document.point_arrays[0], "m");
  const std::string bytes = ugrid.written(document);
  CHECK(says(bytes, "depth of water"));
  const MeshDocument read = ugrid.read(bytes);
  CHECK(unit_of(read.point_arrays[0]) == "m");
  CHECK(read.points == document.points);
  CHECK(read.cells.types == std::vector<std::uint8_t>{9, 5, 3});
  CHECK(values_of<double>(read.point_arrays, "depth_of_water") == std::vector<double>{1, 2, 3, 4, 5});
  CHECK(
      what_is_lost(document, FileFormat::ugrid) ==
      std::vector<std::string>{"UGRID lists cells by their type: they are written in another order",
                               "UGRID gets arrays of real numbers, one a point or face: not written are wind, region",
                               "UGRID has names of variables without blanks and slashes that begin with a letter, each "
                               "once: changed are 'depth of water' (as depth_of_water)"});
  const std::vector<std::string> lost = what_is_lost(document, FileFormat::exodus);
  CHECK(std::ranges::count(lost, "Exodus II holds no units: those of depth of water are not written") == 1);
}

}  // namespace trismooth::ugrid_test

// SPDX-License-Identifier: BSD-3-Clause
#ifdef TRISMOOTH_HAS_HDF5

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/netcdf/netcdf4_file.h"
#include "trismooth/mesh_io/netcdf/netcdf_file.h"

#include "catch.h"
#include "support/netcdf_builder.h"
#include "support/small_hdf5.h"
#include "support/text_format.h"

namespace trismooth::netcdf4_test {

using test_support::NetcdfBuilder;
using test_support::SmallHdf5;
using Naming = NetcdfBuilder::Naming;

namespace {

const TextFormat exodus(".exo");
const TextFormat ugrid(".nc");

NetcdfContent content_of(const std::string& bytes) {
  return open_netcdf4("a.nc", bytes)->content();
}

std::string refusal_of(const std::string& bytes) {
  return message_of<ReadError>([&] { content_of(bytes); });
}

/// Two dimensions of one length, one that grows, and a variable of each two of them.
NetcdfBuilder builder(Naming naming) {
  NetcdfBuilder file(4);
  file.name_dimensions(naming);
  const int first = file.dimension("first", 3);
  const int second = file.dimension("second", 3);
  const int step = file.dimension("step", 0, 2);
  file.attribute({"title", "a mesh"});
  file.variable("square", NetcdfBuilder::float64, {second, first}, {1, 2, 3, 4, 5, 6, 7, 8, 9}, {{"units", "m"}});
  file.variable("grown", NetcdfBuilder::int32, {step, second}, {1, 2, 3, 4, 5, 6}, {{"numbers", "", {1, 2.5}}});
  file.variable("alone", NetcdfBuilder::int32, {}, {7});
  return file;
}

/// A dimension, as netCDF-4 has it.
void add_scale(SmallHdf5& file, const std::string& name, hsize_t length) {
  file.dataset("/" + name, H5T_IEEE_F32BE, {length}, false, "");
  file.text("/" + name, "CLASS", "DIMENSION_SCALE", 16);
  const std::string text = "This is a netCDF dimension but not a netCDF variable.";
  file.text("/" + name, "NAME", text, text.size() + 1);
}

/// A triangle of Exodus II.
NetcdfBuilder triangle() {
  NetcdfBuilder file(4);
  const int nodes = file.dimension("num_nodes", 3);
  const int one = file.dimension("num_el_in_blk1", 1);
  file.dimension("num_dim", 2);
  file.variable("coordx", NetcdfBuilder::float64, {nodes}, {0, 1, 0});
  file.variable("coordy", NetcdfBuilder::float64, {nodes}, {0, 0, 1});
  file.variable("connect1", NetcdfBuilder::int32, {one, file.dimension("three", 3)}, {1, 2, 3},
                {{"elem_type", "TRI3"}});
  return file;
}

}  // namespace

TEST_CASE("netCDF-4: dimensions are told by references and by numbers alike") {
  for (const Naming naming : {Naming::by_reference, Naming::by_number}) {
    const NetcdfContent content = content_of(builder(naming).bytes());
    REQUIRE(content.dimensions.size() == 3);
    CHECK(content.dimensions[0].name == "first");
    CHECK(content.dimensions[2].length == 2);  // which its variable says
    REQUIRE(content.attributes.size() == 1);
    CHECK(content.attributes[0].text == "a mesh");
    REQUIRE(content.variables.size() == 3);
    for (const NetcdfVariable& variable : content.variables) {
      INFO(variable.name);
      if (variable.name == "square") {
        CHECK(variable.dimensions == std::vector<std::size_t>{1, 0});
        CHECK(variable.type == NetcdfType::float64);
        CHECK(variable.text_of("units") == "m");
      } else if (variable.name == "grown") {
        CHECK(variable.dimensions == std::vector<std::size_t>{2, 1});
        CHECK(variable.shape == std::vector<std::size_t>{2, 3});
        REQUIRE(variable.attributes.size() == 1);
        CHECK(variable.attributes[0].numbers == std::vector{1, 2.5});
      } else {
        CHECK(variable.shape.empty());
      }
    }
  }
}

TEST_CASE("netCDF-4: datasets without scales have a dimension for each length, as netCDF has it") {
  const NetcdfContent content = content_of(builder(Naming::not_at_all).bytes());
  CHECK(content.variables.size() == 3);
  for (const NetcdfVariable& variable : content.variables) {
    for (std::size_t i = 0; i < variable.shape.size(); ++i) {
      CHECK(content.dimensions[variable.dimensions[i]].length == variable.shape[i]);
      CHECK(content.dimensions[variable.dimensions[i]].name.starts_with("phony_dim_"));
    }
    if (variable.name == "square") {
      CHECK(variable.dimensions[0] != variable.dimensions[1]);
    }
  }
}

TEST_CASE("netCDF-4: a part of a variable is read, and what was never written is the file's fill value") {
  SmallHdf5 small;
  small.dataset("/empty", H5T_IEEE_F64LE, {4}, false, "");
  small.dataset("/names", H5T_C_S1, {2, 3}, false, "");
  const std::string empty_bytes = small.bytes();
  const auto empty = open_netcdf4("a.nc", empty_bytes);
  for (const NetcdfVariable& variable : empty->content().variables) {
    if (variable.name == "names") {
      CHECK(empty->characters(variable) == std::string(6, '\0'));
    } else {
      std::array<double, 2> values{1, 2};
      empty->read(variable, std::array<std::size_t, 1>{2}, std::array<std::size_t, 1>{2}, ScalarType::float64,
                  values.data());
      CHECK(values == std::array<double, 2>{0, 0});
    }
  }
  const std::string bytes = builder(Naming::by_number).bytes();
  const auto file = open_netcdf4("a.nc", bytes);
  const NetcdfContent content = file->content();
  const auto grown = std::ranges::find(content.variables, "grown", &NetcdfVariable::name);
  REQUIRE(grown != content.variables.end());
  std::array<std::int64_t, 3> row{};
  file->read(*grown, std::array<std::size_t, 2>{1, 0}, std::array<std::size_t, 2>{1, 3}, ScalarType::int64, row.data());
  CHECK(row == std::array<std::int64_t, 3>{4, 5, 6});
  CHECK(message_of<ReadError>([&] {
          file->read(*grown, std::array<std::size_t, 2>{2, 0}, std::array<std::size_t, 2>{1, 3}, ScalarType::int64,
                     row.data());
        }) == "a.nc: '/grown' has not as many values as expected");
}

TEST_CASE("netCDF-4: what a small file declares without having it is refused before memory is taken") {
  SmallHdf5 large;
  large.dataset("/x", H5T_IEEE_F64LE, {hsize_t{1} << 40}, false, "");
  CHECK(refusal_of(large.bytes()) == "a.nc: is damaged: the values of 'x' are more than a file of this size can hold");
  SmallHdf5 many;
  for (int i = 0; i < 20; ++i) {
    many.dataset("/x" + std::to_string(i), H5T_IEEE_F64LE, {hsize_t{1} << 17}, false, "");
  }
  CHECK(refusal_of(many.bytes()).find("are more than a file of this size can hold") != std::string::npos);
  CHECK(refusal_of("\x89HDF\r\n\x1a\n").starts_with("a.nc: is no whole HDF5 file"));
}

TEST_CASE(
    "netCDF-4: references that lead to no dimension leave lengths to tell, and other types are no lists of them") {
  SmallHdf5 file;
  file.dataset("/x", H5T_IEEE_F64LE, {2}, false, "");
  file.references("/x", "DIMENSION_LIST", {"/x"});
  CHECK(content_of(file.bytes()).dimensions.front().name == "phony_dim_0");
  SmallHdf5 numbers;
  numbers.dataset("/x", H5T_IEEE_F64LE, {2}, false, "");
  numbers.attributes("/x", "DIMENSION_LIST", std::vector<std::int32_t>{1});
  CHECK(refusal_of(numbers.bytes()) == "a.nc: '/x:DIMENSION_LIST' is no list of references to objects");
}

TEST_CASE("Exodus: a netCDF-4 file is read, moved and written, and nothing else in it changes") {
  const std::string bytes = triangle().bytes();
  MeshDocument document = exodus.read(bytes);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2});
  CHECK(exodus.written(document) == bytes);
  document.points[3] = 1.5;
  const MeshDocument moved = exodus.read(exodus.written(document));
  CHECK(moved.points == document.points);
}

TEST_CASE("Exodus: variables of netCDF-4 that have not grown with the others stay in the file, with a note") {
  SmallHdf5 file;
  add_scale(file, "num_dim", 2);
  add_scale(file, "num_nodes", 3);
  add_scale(file, "time_step", 0);
  const auto add = [&file](const std::string& name, const std::vector<double>& values, std::vector<hsize_t> extents,
                           const std::vector<std::string>& scales) {
    file.values("/" + name, values, SmallHdf5::Layout::contiguous, std::move(extents));
    file.references("/" + name, "DIMENSION_LIST", scales);
  };
  add("coordx", {0, 1, 0}, {3}, {"/num_nodes"});
  add("coordy", {0, 0, 1}, {3}, {"/num_nodes"});
  add("time_whole", {0, 1}, {2}, {"/time_step"});
  add("vals_nod_var1", {1, 2, 3}, {1, 3}, {"/time_step", "/num_nodes"});
  const MeshDocument document = exodus.read(file.bytes());
  CHECK(document.point_arrays.empty());
  REQUIRE(document.notes.size() == 1);
  CHECK(document.notes[0] ==
        "Variables that have fewer values than their dimensions ask for stay in the file alone: vals_nod_var1.");
}

TEST_CASE("Exodus: names that are strings of HDF5 and not characters are refused") {
  SmallHdf5 file;
  add_scale(file, "num_dim", 2);
  add_scale(file, "num_el_blk", 1);
  const Hdf5Handle strings(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(strings.get(), 4);
  file.dataset("/eb_names", strings.get(), {1}, false, "wall");
  CHECK(exodus.failure_of(file.bytes()) == "mesh.exo: '/eb_names' is of strings, where single characters are expected");
}

TEST_CASE("UGRID: a netCDF-4 file without scales is read by lengths") {
  NetcdfBuilder file(4);
  file.name_dimensions(Naming::not_at_all);
  const int nodes = file.dimension("nodes", 4);
  file.variable("mesh", NetcdfBuilder::int32, {}, {0},
                {{"cf_role", "mesh_topology"},
                 {"topology_dimension", "", {2}},
                 {"node_coordinates", "x y"},
                 {"face_node_connectivity", "faces"}});
  file.variable("x", NetcdfBuilder::float64, {nodes}, {0, 1, 1, 0});
  file.variable("y", NetcdfBuilder::float64, {nodes}, {0, 0, 1, 1});
  file.variable("faces", NetcdfBuilder::int32, {file.dimension("two", 2), file.dimension("three", 3)},
                {0, 1, 2, 0, 2, 3});
  const MeshDocument document = ugrid.read(file.bytes());
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3});
}

}  // namespace trismooth::netcdf4_test

#endif

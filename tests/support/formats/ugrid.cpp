// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "support/format_sample.h"
#include "support/netcdf_builder.h"

namespace accepted_files {

namespace {

using test_support::NetcdfBuilder;

struct UgridSpelling {
  int version = 2;
  NetcdfBuilder::Type real = NetcdfBuilder::float64;
  NetcdfBuilder::Type whole = NetcdfBuilder::int32;
  double start = 0;
  bool is_transposed = false;
  bool has_lines = false;
  bool has_depths = false;
};

std::string ugrid_file(const UgridSpelling& spelling, bool others = false) {
  const Mesh plate = mesh(others);
  NetcdfBuilder file(spelling.version);
  file.name_dimensions(NetcdfBuilder::Naming::by_number);
  const int nodes = file.dimension("nodes", plate.points.size());
  const int faces = file.dimension("faces", plate.faces.size());
  const std::size_t most = others ? 5 : 3;
  const int corners = file.dimension("corners", most);
  std::vector<NetcdfBuilder::Attribute> topology{{"cf_role", "mesh_topology"},
                                                 {"topology_dimension", "", {2}},
                                                 {"node_coordinates", "x y"},
                                                 {"face_node_connectivity", "face_nodes"},
                                                 {"face_dimension", "faces"}};
  if (spelling.has_lines) {
    topology.push_back({"boundary_node_connectivity", "boundary"});
  }
  file.variable("mesh", NetcdfBuilder::int32, {}, {0}, topology);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    for (const auto& point : plate.points) {
      values.push_back(point.at(axis));
    }
    file.variable(axis == 0 ? "x" : "y", spelling.real, {nodes}, values, {{"units", "m"}});
  }
  constexpr double fill = -999;
  std::vector<double> table(most * plate.faces.size(), fill);
  for (std::size_t face = 0; face < plate.faces.size(); ++face) {
    for (std::size_t k = 0; k < plate.faces[face].size(); ++k) {
      table[spelling.is_transposed ? k * plate.faces.size() + face : face * most + k] =
          plate.faces[face][k] + spelling.start;
    }
  }
  file.variable("face_nodes", spelling.whole,
                spelling.is_transposed ? std::vector{corners, faces} : std::vector{faces, corners}, table,
                {{"start_index", "", {spelling.start}}, {"_FillValue", "", {fill}, spelling.whole}});
  if (spelling.has_depths) {
    std::vector<double> depths;
    for (std::size_t i = 0; i < plate.points.size(); ++i) {
      depths.push_back(0.5 * static_cast<double>(i));
    }
    file.variable("depth", spelling.real, {nodes}, depths, {{"location", "node"}});
    file.variable("kind", NetcdfBuilder::int32, {faces}, std::vector<double>(plate.faces.size(), 3));
  }
  if (spelling.has_lines) {
    file.variable("boundary", NetcdfBuilder::int32, {file.dimension("edges", 2), file.dimension("two", 2)},
                  {spelling.start, spelling.start + 1, spelling.start + 1, spelling.start + 2},
                  {{"start_index", "", {spelling.start}}});
  }
  return file.bytes();
}

void add_ugrid(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"ugrid_" + name, ".nc", std::move(bytes)});
  };
  add("plain", ugrid_file({}));
  add("from_one", ugrid_file({.version = 1, .start = 1, .has_depths = true}));
  add("transposed", ugrid_file({.real = NetcdfBuilder::float32, .is_transposed = true, .has_lines = true}, true));
#ifdef TRISMOOTH_HAS_HDF5
  add("netcdf4", ugrid_file({.version = 4, .start = 1, .has_lines = true, .has_depths = true}));
#endif
  add("real_nodes", ugrid_file({.version = 5, .whole = NetcdfBuilder::float64, .start = 1, .has_lines = true}));
}

}  // namespace

/// All values are within the file, and the last fill up their four bytes.
FormatSample ugrid_sample() {
  return {.format = trismooth::FileFormat::ugrid,
          .add_files = &add_ugrid,
          .is_whole = [](const AcceptedFile& file, std::size_t cut) { return cut == file.bytes.size(); },
          .cells = {{cell_type::triangle, cell_type::quad, cell_type::polygon}, {cell_type::line}}};
}

}  // namespace accepted_files

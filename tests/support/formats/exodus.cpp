// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "support/format_sample.h"
#include "support/netcdf_builder.h"

namespace accepted_files {

namespace {

using test_support::NetcdfBuilder;

struct ExodusSpelling {
  int version = 2;
  NetcdfBuilder::Type real = NetcdfBuilder::float64;
  NetcdfBuilder::Type whole = NetcdfBuilder::int32;
  bool has_table = false;  ///< coordinates as one table
  std::size_t axes = 2;
  std::size_t steps = 0;
  bool has_sets = false;
};

std::vector<double> axis_of(const Mesh& mesh, std::size_t axis) {
  std::vector<double> values;
  for (const auto& point : mesh.points) {
    values.push_back(point.at(axis));
  }
  return values;
}

void add_exodus_points(NetcdfBuilder& file, const Mesh& mesh, const ExodusSpelling& spelling, int nodes) {
  const int axes = file.dimension("num_dim", spelling.axes);
  std::vector<double> all;
  for (std::size_t axis = 0; axis < spelling.axes; ++axis) {
    const std::vector<double> values = axis_of(mesh, axis);
    all.insert(all.end(), values.begin(), values.end());
    if (!spelling.has_table) {
      file.variable(std::string("coord") + "xyz"[axis], spelling.real, {nodes}, values);
    }
  }
  if (spelling.has_table) {
    file.variable("coord", spelling.real, {axes, nodes}, all);
  }
}

/// Cells `begin` to before `end`, as a block of that number.
void add_exodus_block(NetcdfBuilder& file, const Mesh& mesh, const ExodusSpelling& spelling, int number,
                      std::size_t begin, std::size_t end, const std::string& type) {
  const std::string suffix = std::to_string(number);
  std::vector<double> nodes;
  std::vector<double> counts;
  for (std::size_t face = begin; face < end; ++face) {
    for (const int vertex : mesh.faces[face]) {
      nodes.push_back(vertex + 1);
    }
    counts.push_back(static_cast<double>(mesh.faces[face].size()));
  }
  const int elements = file.dimension("num_el_in_blk" + suffix, end - begin);
  if (type == "nsided") {
    const int all = file.dimension("num_nod_per_el" + suffix, nodes.size());
    file.variable("connect" + suffix, spelling.whole, {all}, nodes, {{"elem_type", type}});
    file.variable("ebepecnt" + suffix, NetcdfBuilder::int32, {elements}, counts);
    return;
  }
  const int each = file.dimension("num_nod_per_el" + suffix, mesh.faces[begin].size());
  file.variable("connect" + suffix, spelling.whole, {elements, each}, nodes, {{"elem_type", type}});
}

void add_exodus_sets(NetcdfBuilder& file, int length) {
  const int sides = file.dimension("num_side_sets", 2);
  file.variable("ss_prop1", NetcdfBuilder::int32, {sides}, {10, 20});
  file.texts("ss_names", {sides, length}, {"wall", ""});
  const int one = file.dimension("num_side_ss1", 1);
  file.variable("elem_ss1", NetcdfBuilder::int32, {one}, {1});
  file.variable("side_ss1", NetcdfBuilder::int32, {one}, {1});
  const int two = file.dimension("num_side_ss2", 2);
  file.variable("elem_ss2", NetcdfBuilder::int32, {two}, {1, 3});
  file.variable("side_ss2", NetcdfBuilder::int32, {two}, {1, 1});
  const int nodes = file.dimension("num_nod_ns1", 2);
  file.variable("node_ns1", NetcdfBuilder::int32, {nodes}, {1, 4});
}

std::string exodus_file(const ExodusSpelling& spelling, bool others = false) {
  const Mesh plate = mesh(others);
  NetcdfBuilder file(spelling.version);
  file.attribute({"api_version", "", {8.25}, NetcdfBuilder::float32});
  const int length = file.dimension("len_name", 8);
  const int step = spelling.steps > 0 ? file.dimension("time_step", 0, spelling.steps) : -1;
  const int nodes = file.dimension("num_nodes", plate.points.size());
  add_exodus_points(file, plate, spelling, nodes);
  const int blocks = file.dimension("num_el_blk", 2);
  file.variable("eb_prop1", NetcdfBuilder::int32, {blocks}, {7, 3});
  file.texts("eb_names", {blocks, length}, {"lower", "upper"});
  add_exodus_block(file, plate, spelling, 1, 0, 2, "TRI3");
  add_exodus_block(file, plate, spelling, 2, 2, 4, "tri");
  if (others) {
    add_exodus_block(file, plate, spelling, 3, 4, 6, "nsided");
  }
  if (spelling.has_sets) {
    add_exodus_sets(file, length);
  }
  if (spelling.steps > 0) {
    const int names = file.dimension("num_nod_var", 1);
    file.texts("name_nod_var", {names, length}, {"heat"});
    const int more = file.dimension("num_elem_var", 1);
    file.texts("name_elem_var", {more, length}, {"flux"});
    std::vector<double> times;
    std::vector<double> values;
    std::vector<double> fluxes;
    for (std::size_t i = 0; i < spelling.steps; ++i) {
      times.push_back(0.5 * static_cast<double>(i));
      for (std::size_t v = 0; v < plate.points.size(); ++v) {
        values.push_back(static_cast<double>(10 * i + v));
      }
      fluxes.insert(fluxes.end(), {static_cast<double>(i), 0.25});
    }
    file.variable("time_whole", NetcdfBuilder::float64, {step}, times);
    file.variable("vals_nod_var1", spelling.real, {step, nodes}, values);
    file.variable("vals_elem_var1eb2", NetcdfBuilder::float64, {step, 0 + file.dimension("num_of_two", 2)}, fluxes);
  }
  return file.bytes();
}

void add_exodus(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"exodus_" + name, ".exo", std::move(bytes)});
  };
  add("plain", exodus_file({}));
  add("old", exodus_file({.version = 1, .real = NetcdfBuilder::float32, .has_table = true, .axes = 3}));
  add("large", exodus_file({.version = 5, .whole = NetcdfBuilder::int64, .axes = 3}));
  add("sets", exodus_file({.has_sets = true}));
  add("step", exodus_file({.real = NetcdfBuilder::float32, .steps = 1}));
  add("steps", exodus_file({.version = 1, .steps = 3, .has_sets = true}));
  add("polygons", exodus_file({}, true));
#ifdef TRISMOOTH_HAS_HDF5
  add("netcdf4", exodus_file({.version = 4, .axes = 3}));
  add("netcdf4_step", exodus_file({.version = 4, .real = NetcdfBuilder::float32, .steps = 1}));
#endif
}

}  // namespace

/// All values are within the file, and the last fill up their four bytes.
FormatSample exodus_sample() {
  return {.format = trismooth::FileFormat::exodus,
          .add_files = &add_exodus,
          .is_whole = [](const AcceptedFile& file, std::size_t cut) { return cut == file.bytes.size(); },
          .cells = {{cell_type::triangle, cell_type::quad, cell_type::polygon, cell_type::quadratic_triangle,
                     cell_type::quadratic_quad, cell_type::biquadratic_quad, cell_type::tetrahedron, cell_type::pyramid,
                     cell_type::wedge, cell_type::hexahedron, cell_type::quadratic_tetrahedron,
                     cell_type::quadratic_hexahedron, cell_type::quadratic_wedge}},
          .has_own_order = true};
}

}  // namespace accepted_files

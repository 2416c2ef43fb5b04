// SPDX-License-Identifier: BSD-3-Clause
#include "support/format_sample.h"

#ifdef TRISMOOTH_HAS_HDF5

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/small_cgns.h"

#endif

namespace accepted_files {

#ifdef TRISMOOTH_HAS_HDF5

namespace {

using test_support::SmallCgns;
using Layout = SmallCgns::Layout;

/// How a CGNS file has the mesh.
struct CgnsSpelling {
  bool has_others = false;
  std::int32_t axes = 2;
  Layout layout = Layout::contiguous;
};

template <class Real>
void add_cgns_mesh(SmallCgns& file, const CgnsSpelling& spelling) {
  const Mesh all = mesh(spelling.has_others);
  file.base(spelling.axes);
  file.zone("Z", static_cast<std::int32_t>(all.points.size()), static_cast<std::int32_t>(all.faces.size()));
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(spelling.axes); ++axis) {
    std::vector<Real> values;
    for (const auto& point : all.points) {
      values.push_back(static_cast<Real>(point.at(axis)));
    }
    file.coordinate("Z", static_cast<char>('X' + axis), values, spelling.layout);
  }
  std::vector<std::int32_t> nodes;
  for (std::size_t i = 0; i < 4; ++i) {
    for (const int vertex : all.faces[i]) {
      nodes.push_back(vertex + 1);
    }
  }
  file.section("Z/T", 5, 1, 4, nodes);
  if (spelling.has_others) {
    // Two polygons, as files of version 4 list them.
    file.section("Z/P", 22, 5, 6, {2, 6, 7, 3, 4, 3, 7, 8, 9});
    file.values("/B/Z/P/ElementStartOffset", "DataArray_t", "I4", std::vector<std::int32_t>{0, 4, 9});
  }
}

void add_cgns(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, SmallCgns& file) {
    files.push_back({"cgns_" + name, ".cgns", file.bytes()});
  };
  const auto plain = [&add]<class Real>(const std::string& name, const CgnsSpelling& spelling, Real) {
    SmallCgns file;
    add_cgns_mesh<Real>(file, spelling);
    add(name, file);
  };
  plain("flat", {}, double{});
  plain("in_space", {.axes = 3}, double{});
  plain("float32", {}, float{});
  plain("polygons", {.has_others = true}, double{});
  plain("big_endian", {.layout = Layout::big_endian}, double{});
  plain("deflated", {.layout = Layout::deflated}, double{});
  SmallCgns mixed;
  mixed.base(2);
  mixed.zone("Z", 5, 4);
  mixed.coordinate("Z", 'X', std::vector<double>{0, 2, 2, 0, 0.75});
  mixed.coordinate("Z", 'Y', std::vector<double>{0, 0, 2, 2, 1.25});
  mixed.section("Z/M", 20, 1, 4, {5, 1, 2, 5, 5, 2, 3, 5, 5, 3, 4, 5, 5, 4, 1, 5});
  add("mixed", mixed);
  SmallCgns grouped;
  add_cgns_mesh<double>(grouped, {});
  grouped.condition("Z", "left", "CellCenter", {1, 2});
  grouped.condition("Z", "corners", "Vertex", {1, 3});
  add("groups", grouped);
  SmallCgns solved;
  add_cgns_mesh<double>(solved, {});
  solved.node("/B/Z/S", "FlowSolution_t", "MT");
  solved.values("/B/Z/S/heat", "DataArray_t", "R8", std::vector<double>{1, 2, 3, 4, 5});
  add("solution", solved);
}

}  // namespace

#else

namespace {

void add_cgns(std::vector<AcceptedFile>& /*files*/) {}

}  // namespace

#endif

FormatSample cgns_sample() {
  return {.format = trismooth::FileFormat::cgns,
          .add_files = &add_cgns,
          .is_whole = [](const AcceptedFile& /*file*/, std::size_t /*cut*/) { return false; },
          .cells = {{cell_type::vertex, cell_type::line, cell_type::quadratic_edge, cell_type::cubic_line,
                     cell_type::triangle, cell_type::quad, cell_type::quadratic_triangle, cell_type::quadratic_quad,
                     cell_type::biquadratic_quad, cell_type::tetrahedron, cell_type::pyramid, cell_type::wedge,
                     cell_type::hexahedron, cell_type::quadratic_tetrahedron, cell_type::quadratic_pyramid,
                     cell_type::quadratic_wedge, cell_type::quadratic_hexahedron, cell_type::polygon}},
          .has_own_order = true,
          .holds_cell = [](std::uint8_t type,
                           std::size_t vertices) { return type != cell_type::polygon || vertices >= 3; }};
}

}  // namespace accepted_files

// SPDX-License-Identifier: BSD-3-Clause
#include "support/format_sample.h"

#ifdef TRISMOOTH_HAS_HDF5

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/small_hdf5.h"

#endif

namespace accepted_files {

#ifdef TRISMOOTH_HAS_HDF5

namespace {

using test_support::SmallHdf5;
using Layout = SmallHdf5::Layout;

const std::string med_mesh = "/ENS_MAA/plate";

/// How a MED file has the mesh.
struct MedSpelling {
  bool has_others = false;
  std::size_t axes = 2;
  bool has_steps = true;
  Layout layout = Layout::contiguous;
};

template <class Real, class Integer>
void add_med_mesh(SmallHdf5& file, const MedSpelling& spelling) {
  const Mesh all = mesh(spelling.has_others);
  file.group("/ENS_MAA");
  file.group(med_mesh);
  file.attribute(med_mesh, "ESP", static_cast<std::int32_t>(spelling.axes));
  const std::string step = med_mesh + (spelling.has_steps ? "/one" : "");
  if (spelling.has_steps) {
    file.group(step);
  }
  file.group(step + "/NOE");
  std::vector<Real> by_axis;
  for (std::size_t axis = 0; axis < spelling.axes; ++axis) {
    for (const auto& point : all.points) {
      by_axis.push_back(static_cast<Real>(point.at(axis)));
    }
  }
  file.values(step + "/NOE/COO", by_axis, spelling.layout);
  file.group(step + "/MAI");
  const std::vector<std::string> names{"TR3", "QU4", "POG"};
  for (std::size_t size = 3; size <= 5; ++size) {
    std::vector<Integer> nodes;
    for (std::size_t k = 0; k < size; ++k) {
      for (const auto& face : all.faces) {
        if (face.size() == size) {
          nodes.push_back(static_cast<Integer>(face[k] + 1));
        }
      }
    }
    const std::string group = step + "/MAI/" + names[size - 3];
    if (!nodes.empty()) {
      file.group(group);
      file.values(group + "/NOD", nodes, spelling.layout);
      if (size == 5) {
        file.values(group + "/INN", std::vector<Integer>{1, 6});
      }
    }
  }
}

std::string med_name(std::string name) {
  name.resize(80, ' ');
  return name;
}

void add_med_families(SmallHdf5& file) {
  const std::string step = med_mesh + "/one";
  file.values(step + "/NOE/NUM", std::vector<std::int32_t>{10, 20, 30, 40, 50});
  file.values(step + "/NOE/FAM", std::vector<std::int32_t>{3, 0, 3, 0, 0});
  file.values(step + "/MAI/TR3/FAM", std::vector<std::int32_t>{-1, -1, -2, 0});
  const std::string families = "/FAS/plate";
  file.group("/FAS");
  file.group(families);
  const auto add = [&](const std::string& kind, const std::string& name, std::int32_t number,
                       const std::string& groups) {
    const std::string family = families + "/" + kind + "/" + name;
    file.group(family);
    file.attribute(family, "NUM", number);
    file.group(family + "/GRO");
    file.rows(family + "/GRO/NOM", 80, groups);
  };
  file.group(families + "/NOEUD");
  add("NOEUD", "c", 3, med_name("corners"));
  file.group(families + "/ELEME");
  add("ELEME", "a", -1, med_name("left side"));
  add("ELEME", "b", -2, med_name("left side") + med_name("top"));
}

void add_med_field(SmallHdf5& file) {
  file.group("/CHA");
  file.group("/CHA/heat");
  file.text("/CHA/heat", "MAI", "plate", 64);
  file.group("/CHA/heat/s");
  file.group("/CHA/heat/s/NOE");
  const std::string values = "/CHA/heat/s/NOE/MED_NO_PROFILE_INTERNAL";
  file.group(values);
  file.values(values + "/CO", std::vector<double>{1, 2, 3, 4, 5, 10, 20, 30, 40, 50});
}

void add_med(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, SmallHdf5& file) {
    files.push_back({"med_" + name, ".med", file.bytes()});
  };
  const auto plain = [&add]<class Real, class Integer>(const std::string& name, const MedSpelling& spelling, Real,
                                                       Integer) {
    SmallHdf5 file;
    add_med_mesh<Real, Integer>(file, spelling);
    add(name, file);
  };
  plain("flat", {}, double{}, std::int32_t{});
  plain("in_space", {.axes = 3}, double{}, std::int64_t{});
  plain("float32", {}, float{}, std::int32_t{});
  plain("old", {.has_steps = false}, double{}, std::int32_t{});
  plain("polygons", {.has_others = true}, double{}, std::int32_t{});
  plain("big_endian", {.layout = Layout::big_endian}, double{}, std::int32_t{});
  plain("compact", {.layout = Layout::compact}, double{}, std::int32_t{});
  plain("deflated", {.layout = Layout::deflated}, double{}, std::int32_t{});
  SmallHdf5 with_groups;
  add_med_mesh<double, std::int32_t>(with_groups, {});
  add_med_families(with_groups);
  add("groups", with_groups);
  SmallHdf5 with_field;
  add_med_mesh<double, std::int32_t>(with_field, {});
  add_med_field(with_field);
  add("field", with_field);
}

}  // namespace

#else

namespace {

void add_med(std::vector<AcceptedFile>& /*files*/) {}

}  // namespace

#endif

FormatSample med_sample() {
  constexpr std::uint8_t biquadratic_triangle = 34;
  return {.format = trismooth::FileFormat::med,
          .add_files = &add_med,
          .is_whole = [](const AcceptedFile& /*file*/, std::size_t /*cut*/) { return false; },
          .cells = {{cell_type::vertex},
                    {cell_type::line},
                    {cell_type::quadratic_edge},
                    {cell_type::cubic_line},
                    {cell_type::triangle},
                    {cell_type::quad},
                    {cell_type::quadratic_triangle},
                    {biquadratic_triangle},
                    {cell_type::quadratic_quad},
                    {cell_type::biquadratic_quad},
                    {cell_type::tetrahedron},
                    {cell_type::pyramid},
                    {cell_type::wedge},
                    {cell_type::hexahedron},
                    {cell_type::quadratic_tetrahedron},
                    {cell_type::quadratic_pyramid},
                    {cell_type::quadratic_wedge},
                    {cell_type::quadratic_hexahedron},
                    {cell_type::polygon}},
          .holds_cell = [](std::uint8_t type,
                           std::size_t vertices) { return type != cell_type::polygon || vertices >= 3; }};
}

}  // namespace accepted_files

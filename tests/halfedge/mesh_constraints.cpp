// SPDX-License-Identifier: BSD-3-Clause
// What MeshConstraints are made from.

#include "trismooth/mesh_io/halfedge/mesh_constraints.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/own_meshes.h"

namespace own_meshes {

using planar_samples::Sample;
using trismooth::MeshConstraints;

namespace {

enum class Material : std::uint16_t { air, iron };

/// Numbers of a mesh in every form, and what flat arrays make of them.
struct Case {
  Sample sample = shuffled_grid(12, 21);
  std::vector<std::uint8_t> fixed;
  std::vector<std::int32_t> regions;
  FullMesh mesh = mesh_of<FullMesh>(sample);

  Case() {
    for (std::size_t v = 0; v < sample.xyz.size() / 3; ++v) {
      fixed.push_back(v % 7 == 0 ? 1 : 0);
    }
    for (const auto& [a, b, c] : sample.triangles) {
      const double sum = sample.xyz[3 * a] + sample.xyz[3 * b] + sample.xyz[3 * c];
      regions.push_back(sum < 15 ? 0 : 1);
    }
    for (const auto v : mesh.vertices()) {
      mesh.data(v).bc = fixed[static_cast<std::size_t>(v.idx())];
    }
    for (const auto f : mesh.faces()) {
      mesh.data(f).material = regions[static_cast<std::size_t>(f.idx())];
    }
  }

  std::vector<double> expected() const {
    std::vector<double> xy = sample.xy();
    trismooth::smooth(trismooth::xy_points(xy), sample.triangles,
                      trismooth::Constraints{.fixed = fixed, .regions = regions});
    return xy;
  }

  std::vector<double> smoothed(const MeshConstraints& constraints) const {
    FullMesh copy = mesh;
    trismooth::smooth(copy, constraints);
    return xy_in(copy);
  }

  /// Adds properties of both kinds with these numbers.
  template <class T>
  std::pair<OpenMesh::VPropHandleT<T>, OpenMesh::FPropHandleT<T>> add_properties(const std::string& name) {
    OpenMesh::VPropHandleT<T> of_vertices;
    OpenMesh::FPropHandleT<T> of_faces;
    mesh.add_property(of_vertices, name);
    mesh.add_property(of_faces, name);
    for (const auto v : mesh.vertices()) {
      mesh.property(of_vertices, v) = static_cast<T>(fixed[static_cast<std::size_t>(v.idx())]);
    }
    for (const auto f : mesh.faces()) {
      mesh.property(of_faces, f) = static_cast<T>(regions[static_cast<std::size_t>(f.idx())]);
    }
    return {of_vertices, of_faces};
  }
};

}  // namespace

TEST_CASE("constraints by array, property, name and function are the same constraints") {
  Case c;
  const std::vector<double> expected = c.expected();
  REQUIRE(c.smoothed({}) != expected);
  REQUIRE(c.smoothed({.fixed = c.fixed}) != expected);
  REQUIRE(c.smoothed({.regions = c.regions}) != expected);

  CHECK(c.smoothed({.fixed = c.fixed, .regions = c.regions}) == expected);
  const std::vector<std::int64_t> wide_fixed(c.fixed.begin(), c.fixed.end());
  const std::vector<std::uint8_t> narrow_regions(c.regions.begin(), c.regions.end());
  CHECK(c.smoothed({.fixed = std::span(wide_fixed), .regions = narrow_regions}) == expected);
  std::vector<std::int32_t> ids;
  for (std::size_t v = 0; v < c.fixed.size(); ++v) {
    if (c.fixed[v] != 0) {
      ids.insert(ids.end(), {static_cast<std::int32_t>(v), static_cast<std::int32_t>(v)});
    }
  }
  CHECK(c.smoothed({.fixed_ids = ids, .regions = c.regions}) == expected);
  CHECK(c.smoothed({.other_cells = c.fixed, .regions = c.regions}) == expected);
  CHECK(c.smoothed({.fixed = [&](OpenMesh::VertexHandle v) { return c.mesh.data(v).bc == 1; },
                    .regions = [&](auto f) { return c.mesh.data(f).material; }}) == expected);
}

TEMPLATE_TEST_CASE("a property of any integer type or bool is taken by its handle and by its name", "", bool, char,
                   signed char, unsigned char, short, unsigned short, int, unsigned int, long, unsigned long, long long,
                   unsigned long long) {
  Case c;
  const auto [of_vertices, of_faces] = c.add_properties<TestType>("numbers");
  const std::vector<double> expected = c.expected();
  CHECK(c.smoothed({.fixed = of_vertices, .regions = of_faces}) == expected);
  CHECK(c.smoothed({.fixed = "numbers", .regions = std::string("numbers")}) == expected);
}

TEST_CASE("enumerations are taken by handle and from functions, properties from OpenMesh's manager") {
  Case c;
  const auto [of_vertices, of_faces] = c.add_properties<Material>("materials");
  const std::vector<double> expected = c.expected();
  CHECK(c.smoothed({.fixed = of_vertices, .regions = of_faces}) == expected);
  const auto material = [&mesh = c.mesh, property = of_faces](OpenMesh::FaceHandle f) {
    return mesh.property(property, f);
  };
  CHECK(c.smoothed({.fixed = c.fixed, .regions = material}) == expected);
  const OpenMesh::VProp<Material> vertices(c.mesh, "materials");
  const OpenMesh::FProp<Material> faces(c.mesh, "materials");
  const std::size_t properties = c.mesh.n_fprops();
  trismooth::smooth(c.mesh, {.fixed = vertices, .regions = faces});
  CHECK(xy_in(c.mesh) == expected);
  CHECK(c.mesh.n_fprops() == properties);
}

TEST_CASE("regions beyond 32 bits are told apart") {
  Case c;
  const std::vector<double> expected = c.smoothed({.regions = c.regions});
  const std::int64_t step = GENERATE(std::int64_t{1} << 32, std::numeric_limits<std::int64_t>::min());
  std::vector<std::int64_t> regions;
  for (const std::int32_t region : c.regions) {
    regions.push_back(7 + (region == 0 ? 0 : step));
  }
  CHECK(c.smoothed({.regions = regions}) == expected);
  const std::vector<std::uint64_t> other(regions.begin(), regions.end());
  CHECK(c.smoothed({.regions = other}) == expected);
}

TEST_CASE("arrays have a number for deleted faces too, which says nothing; functions are not asked for these") {
  Case c;
  c.mesh.delete_face(OpenMesh::FaceHandle(5), true);
  FullMesh collected = c.mesh;
  collected.garbage_collection();
  c.regions[5] = 99;
  const std::vector<double> by_array = c.smoothed({.regions = c.regions});
  CHECK(c.smoothed({.regions = [&](OpenMesh::FaceHandle f) {
    if (c.mesh.status(f).deleted()) {
      throw std::runtime_error("asked for a deleted face");
    }
    return c.mesh.data(f).material;
  }}) == by_array);
  trismooth::smooth(collected, {.regions = [&](auto f) { return collected.data(f).material; }});
  std::vector<double> of_collected = xy_in(collected);
  std::vector<double> of_mesh = by_array;
  std::sort(of_collected.begin(), of_collected.end());
  std::sort(of_mesh.begin(), of_mesh.end());
  CHECK(std::includes(of_mesh.begin(), of_mesh.end(), of_collected.begin(), of_collected.end()));
}

TEST_CASE("vertices slide on a mesh of one's own as on flat arrays") {
  Case c;
  for (std::size_t i = 0; i < c.sample.xyz.size(); i += 3) {  // unequal steps along a side
    const double x = c.sample.xyz[i];
    if (c.sample.xyz[i + 1] == 0 && std::fmod(x, 2) == 1) {
      c.sample.xyz[i] += 0.4;
    }
  }
  c.mesh = mesh_of<FullMesh>(c.sample);
  std::vector<double> xy = c.sample.xy();
  const trismooth::Sliding slide{.along = trismooth::Slide::straight};
  const auto expected = trismooth::smooth(trismooth::xy_points(xy), c.sample.triangles,
                                          trismooth::Constraints{.regions = c.regions, .slide = slide});
  const auto result = trismooth::smooth(c.mesh, {.regions = c.regions, .slide = slide});
  CHECK(xy_in(c.mesh) == xy);
  REQUIRE(result.sliding);
  CHECK(result.sliding->slid == expected.sliding->slid);
  CHECK(result.sliding->slid > 0);
}

TEST_CASE("a mesh in a tilted plane, where nothing slides, is refused with what to do") {
  Case c;
  c.mesh = mesh_of<FullMesh>(c.sample, tilted);
  const auto before = numbers_in(c.mesh);
  const trismooth::Sliding slide{.along = trismooth::Slide::straight};
  CHECK(error_of([&] { trismooth::smooth(c.mesh, {.slide = slide}); }) ==
        "slide: the mesh lies in a tilted plane, where rounding takes points off their lines; leave it out");
  CHECK(numbers_in(c.mesh) == before);
}

TEST_CASE("flags of bool and functions of smart handles say what arrays of numbers do") {
  Case c;
  std::vector<bool> flags(c.mesh.n_vertices());
  std::vector<std::uint8_t> bytes(flags.size());
  for (const auto v : c.mesh.vertices()) {
    flags[static_cast<std::size_t>(v.idx())] = v.idx() % 5 == 0;
    bytes[static_cast<std::size_t>(v.idx())] = v.idx() % 5 == 0 ? 3 : 0;
  }
  auto by_bytes = c.mesh;
  auto by_flags = c.mesh;
  auto by_handles = c.mesh;
  const auto result = trismooth::smooth(by_bytes, {.fixed = bytes});
  trismooth::smooth(by_flags, {.fixed = flags});
  trismooth::smooth(by_handles,
                    {.fixed = [](OpenMesh::SmartVertexHandle v) { return v.idx() % 5 == 0 && v.valence() > 0; }});
  CHECK(result.free_vertices > 0);
  CHECK(numbers_in(by_flags) == numbers_in(by_bytes));
  CHECK(numbers_in(by_handles) == numbers_in(by_bytes));
}

TEST_CASE("a property that is not there or holds no whole numbers is named, with those that are there") {
  Case c;
  c.add_properties<int>("material");
  c.add_properties<double>("temperature");
  const auto before = numbers_in(c.mesh);
  const auto error = [&](const MeshConstraints& constraints) {
    CHECK_THROWS_AS(trismooth::smooth(c.mesh, constraints), std::invalid_argument);
    return error_of([&] { trismooth::smooth(c.mesh, constraints); });
  };
  const std::string unknown = error({.regions = "materials"});
  CHECK(unknown.starts_with(
      "MeshConstraints::regions: the mesh has no face property \"materials\"; its face properties: \""));
  CHECK(unknown.find("\"f:status\"") != std::string::npos);
  CHECK(unknown.ends_with("\"material\", \"temperature\""));
  const std::string no_integers = error({.fixed = "temperature"});
  CHECK(
      no_integers.starts_with("MeshConstraints::fixed: the values of the vertex property \"temperature\" are neither "
                              "bool nor integers; its vertex properties: \""));
  CHECK(no_integers.ends_with("\"material\", \"temperature\""));
  CHECK(error({.other_cells = "x"}).starts_with("MeshConstraints::other_cells: the mesh has no vertex property \"x\""));

  const OpenMesh::FPropHandleT<int> none;
  const OpenMesh::FPropHandleT<int> elsewhere(1000);
  for (const auto& handle : {none, elsewhere}) {
    CHECK(error({.regions = handle}).starts_with("MeshConstraints::regions: the handle is that of no face property"));
  }
  OpenMesh::FPropHandleT<float> heights;
  c.mesh.add_property(heights, "heights");
  CHECK(error({.regions = OpenMesh::FPropHandleT<int>(heights.idx())})
            .find("or of one of another type; its face properties") != std::string::npos);
  const std::vector<std::uint8_t> few(c.mesh.n_vertices() - 1, 0);
  CHECK(error({.fixed = few}).starts_with("MeshConstraints::fixed has 168 entries, expected one for each of 169 vert"));
  const std::vector<std::int32_t> ids{169};
  CHECK(error({.fixed_ids = ids}).find("169") != std::string::npos);
  CHECK(numbers_in(c.mesh) == before);
}

}  // namespace own_meshes

// SPDX-License-Identifier: BSD-3-Clause
// What is no mesh is refused on the device as on the host, with the same message.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "trismooth/base/triangle_view.h"

#include "catch.h"
#include "support/test_meshes.h"
#include "topology_ways.h"

using test_meshes::Mesh;
using topology_ways::require_same_error;
using trismooth::Triangle;

namespace {

/// A Moebius band of which all but six triangles are an open fan around vertex 0: that it has one side only shows where
/// triangles are joined over the edges at that vertex.
Mesh twisted_fan(std::int32_t size) {
  Mesh mesh;
  const std::int32_t last = 1 + size;  // the fan runs over 1 .. last
  for (std::int32_t v = 0; v <= last + 4; ++v) {
    mesh.points.push_back({std::cos(v), std::sin(v)});
  }
  for (std::int32_t v = 1; v < last; ++v) {
    mesh.triangles.push_back({0, v, v + 1});
  }
  const auto [a, b, c, d] = std::array{last + 1, last + 2, last + 3, last + 4};
  mesh.triangles.insert(mesh.triangles.end(), {{0, last, b}, {0, b, a}, {a, b, d}, {a, d, c}, {c, d, 0}, {c, 0, 1}});
  return mesh;
}

}  // namespace

TEST_CASE("a surface that cannot be oriented is refused with the host's message") {
  for (std::int32_t length = 3; length < 9; ++length) {
    const Mesh band = test_meshes::moebius_band(length);
    require_same_error(band);
    require_same_error(test_meshes::shuffled(band, 1));
    require_same_error(test_meshes::partly_reversed(band, 2));
    require_same_error(test_meshes::together(test_meshes::star(50), band, {3, 3}));
  }
  require_same_error(test_meshes::shuffled(test_meshes::moebius_band(20000), 3));
  for (const std::int32_t size : {5, 60, 3000}) {
    require_same_error(twisted_fan(size));
    require_same_error(test_meshes::shuffled(twisted_fan(size), 1));
  }
}

TEST_CASE("triangles with an index out of range or a vertex twice are refused with the host's message") {
  const std::vector<Triangle> bad_triangles{{0, 1, 5}, {-1, 1, 2}, {1, 2147483647, 2}, {1, 1, 2},
                                            {1, 2, 1}, {2, 1, 1},  {-2147483648, 0, 1}};
  for (const Triangle& bad : bad_triangles) {
    Mesh mesh = test_meshes::star(4);
    mesh.triangles.insert(mesh.triangles.begin() + 2, bad);
    require_same_error(mesh);
    mesh.triangles.push_back({7, 7, 7});
    require_same_error(mesh);
  }
  require_same_error({{}, {{0, 1, 2}}});
}

TEST_CASE("constraints that do not fit are refused with the host's message, after the triangles") {
  const Mesh mesh = test_meshes::star(6);
  const std::vector<std::int32_t> out_of_range{0, 1000};
  const std::vector<std::int32_t> too_high{0, 7, -1};
  const std::vector<std::int32_t> negative{0, -1, 7};
  const std::vector<std::uint8_t> short_flags(3, 1);
  const std::vector<std::int32_t> long_regions(7, 1);
  for (const Mesh& any : {mesh, test_meshes::together(mesh, test_meshes::moebius_band(5), {9, 9})}) {
    require_same_error(any, {.fixed_ids = out_of_range});
    require_same_error(any, {.fixed = short_flags});
    require_same_error(any, {.other_cells = short_flags});
    require_same_error(any, {.regions = long_regions});
  }
  require_same_error(mesh, {.fixed_ids = too_high});
  require_same_error(mesh, {.fixed_ids = negative});
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/listed_rings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"
#include "trismooth/smoothing/rings/mesh_connectivity.h"
#include "trismooth/smoothing/rings/vertex_rim.h"

#include "catch.h"
#include "support/hostile_meshes.h"
#include "support/listed_rings.h"
#include "support/test_meshes.h"

using listed_rings::require_those_of_matched_sides;
using listed_rings::same;
using test_meshes::Mesh;
using test_meshes::Random;
using trismooth::Constraints;
using trismooth::Fan;
using trismooth::find_listed_rings;
using trismooth::MeshConnectivity;
using trismooth::OneRings;
using trismooth::RimEdge;
using trismooth::Triangle;
using trismooth::TriangleTopology;
using trismooth::Workers;

namespace {

/// The triangles, those of every `turn`-th component listed the other way round.
std::vector<Triangle> turned(std::vector<Triangle> triangles, const std::vector<std::int32_t>& components, int turn) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (components[t] % turn == 0) {
      std::swap(triangles[t][1], triangles[t][2]);
    }
  }
  return triangles;
}

/// `count` stars of 3 to 64 triangles and single triangles, apart from each other.
Mesh many_pieces(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<double>(3 * i);
    mesh = test_meshes::together(
        std::move(mesh), i % 3 == 0 ? test_meshes::triangles_of_areas({1}) : test_meshes::star(3 + i % 62), {x, 0});
  }
  return mesh;
}

Fan fan_of(const std::vector<RimEdge>& rim) {
  return trismooth::walk_rim(rim, [](int /*place*/, std::int32_t /*vertex*/, std::int32_t /*edge*/) {});
}

}  // namespace

TEST_CASE("a closed rim is walked from its smallest vertex, in the direction of its edges") {
  std::array<std::int32_t, 4> ring{};
  const std::vector<RimEdge> rim{{7, 3}, {9, 5}, {3, 9}, {5, 7}};
  std::array<std::int32_t, 4> edges{};
  REQUIRE(trismooth::walk_rim(rim, [&](int place, std::int32_t vertex, std::int32_t edge) {
            ring[static_cast<std::size_t>(place)] = vertex;
            edges[static_cast<std::size_t>(place)] = edge;
          }) == Fan::closed);
  CHECK(ring == std::array<std::int32_t, 4>{3, 9, 5, 7});
  CHECK(edges == std::array<std::int32_t, 4>{2, 1, 3, 0});
}

TEST_CASE("rims that are one path, and rims that are neither a circle nor a path, are told apart") {
  CHECK(fan_of({{1, 2}}) == Fan::open);
  CHECK(fan_of({{2, 1}, {4, 2}, {3, 4}}) == Fan::open);
  // Two circles, apart and through one vertex.
  CHECK(fan_of({{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}}) == Fan::other);
  CHECK(fan_of({{1, 2}, {2, 3}, {3, 1}, {1, 5}, {5, 6}, {6, 1}}) == Fan::other);
  CHECK(fan_of({{3, 2}, {2, 1}, {1, 3}, {3, 5}, {5, 6}, {6, 3}}) == Fan::other);
  // Two paths, a path beside a circle, a path into a circle and out of one.
  CHECK(fan_of({{1, 2}, {3, 4}}) == Fan::other);
  CHECK(fan_of({{1, 2}, {3, 4}, {4, 5}, {5, 3}}) == Fan::other);
  CHECK(fan_of({{1, 2}, {2, 3}, {3, 4}, {4, 2}}) == Fan::other);
  CHECK(fan_of({{2, 3}, {3, 4}, {4, 2}, {2, 1}}) == Fan::other);
  // A triangle that is listed the other way round, and one twice, alike or not.
  CHECK(fan_of({{1, 2}, {3, 2}, {3, 1}}) == Fan::other);
  CHECK(fan_of({{1, 2}, {1, 2}}) == Fan::other);
  CHECK(fan_of({{1, 2}, {2, 1}}) == Fan::other);
  CHECK(fan_of({{1, 2}, {2, 3}, {2, 3}, {3, 1}}) == Fan::other);
}

TEST_CASE("rings as they are listed are those of matched sides, or there are none: soups") {
  Random random(7);
  int found = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    CAPTURE(i);
    const std::int32_t vertices = 3 + random.below(12);
    const std::vector<Triangle> soup = test_meshes::random_soup(vertices, random.below(9), random);
    Workers workers(1);
    try {
      trismooth::connect_triangles(vertices, soup, workers);
    } catch (const trismooth::MeshError&) {
      REQUIRE_FALSE(find_listed_rings(vertices, soup, workers));
      ++refused;
      continue;
    }
    found += require_those_of_matched_sides(vertices, soup, 1) ? 1 : 0;
  }
  CHECK(found > 400);
  CHECK(refused > 0);
}

TEST_CASE("rings as they are listed are those of matched sides, or there are none: meshes of every kind") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    require_those_of_matched_sides(mesh.vertex_count(), mesh.triangles, 1);
    const Mesh shuffled = test_meshes::shuffled(mesh, 5);
    require_those_of_matched_sides(mesh.vertex_count(), shuffled.triangles, 3);
  }
  for (const Mesh& mesh : {hostile_meshes::wheel(64), hostile_meshes::wheel(65), hostile_meshes::windmill(20),
                           hostile_meshes::book(5), hostile_meshes::chain(400)}) {
    require_those_of_matched_sides(mesh.vertex_count(), mesh.triangles, 2);
  }
}

TEST_CASE("rings as they are listed are the same for every number of threads, in meshes of several parts") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(200, 200, 0.3, 1), 2);
  for (const int threads : {1, 2, 3, 8}) {
    CAPTURE(threads);
    CHECK(require_those_of_matched_sides(mesh.vertex_count(), mesh.triangles, threads));
  }
}

TEST_CASE("rings as they are listed are found where more vertices are numbered than are looked at at once") {
  // Vertices of a small mesh, numbered far apart: all others are isolated.
  const Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 1);
  constexpr std::int32_t apart = 2700;
  std::vector<Triangle> triangles = mesh.triangles;
  for (Triangle& triangle : triangles) {
    for (std::int32_t& v : triangle) {
      v = apart * v + 17;
    }
  }
  CHECK(require_those_of_matched_sides(apart * mesh.vertex_count() + 1000, triangles, 2));
}

TEST_CASE("components that are turned over have their rings the other way round, and keep their numbers") {
  const Mesh mesh = test_meshes::shuffled(many_pieces(150), 3);
  Workers workers(2);
  const auto before = trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
  const std::vector<std::int32_t> components(before.component.begin(), before.component.end());
  for (const int turn : {1, 2, 5}) {
    CAPTURE(turn);
    const std::vector<Triangle> triangles = turned(mesh.triangles, components, turn);
    const MeshConnectivity connectivity(mesh.vertex_count(), triangles, workers);
    REQUIRE(connectivity.components().alike);
    const auto reversed = trismooth::orient(connectivity.components(), triangles, mesh.points, workers).reversed;
    const TriangleTopology topology = trismooth::connect_triangles(mesh.vertex_count(), triangles, workers);
    const auto fixed = connectivity.fixed_vertices(triangles, {}, workers);
    CHECK(same(connectivity.one_rings(triangles, reversed, fixed, workers),
               trismooth::one_rings(topology, triangles, reversed, fixed, workers)));
  }
}

TEST_CASE("constraints hold the same vertices, and leave the same rings, whoever found the neighbours") {
  Random random(11);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    for (int i = 0; i < 5; ++i) {
      CAPTURE(name, i);
      std::vector<std::int32_t> regions(mesh.triangles.size());
      std::ranges::generate(regions, [&] { return random.below(20) == 0 ? 1 : i; });
      std::vector<std::uint8_t> named(mesh.points.size());
      std::ranges::generate(named, [&] { return static_cast<std::uint8_t>(random.below(8) == 0); });
      const std::vector<std::int32_t> ids{0, mesh.vertex_count() - 1};
      Constraints constraints;
      constraints.regions = regions;
      constraints.fixed = named;
      constraints.fixed_ids = ids;
      Workers workers(1 + i % 3);
      MeshConnectivity connectivity(mesh.vertex_count(), mesh.triangles, workers);
      const TriangleTopology topology = trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
      const auto fixed = connectivity.fixed_vertices(mesh.triangles, constraints, workers);
      REQUIRE(fixed == trismooth::fixed_vertices(topology, mesh.triangles, constraints, workers));
      const OneRings expected = trismooth::one_rings(topology, mesh.triangles, topology.parity, fixed, workers);
      REQUIRE(same(connectivity.one_rings(mesh.triangles, topology.parity, fixed, workers), expected));
      const OneRings last = std::move(connectivity).one_rings(mesh.triangles, topology.parity, fixed, workers);
      REQUIRE(same(last, expected));
    }
  }
}

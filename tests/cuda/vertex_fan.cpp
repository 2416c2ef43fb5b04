// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/topology/vertex_fan.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

#include "catch.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Random;
using trismooth::MeshRings;
using trismooth::TriangleTopology;
using trismooth::Workers;
using trismooth::cuda::FanPairs;
using trismooth::cuda::TriangleList;
using trismooth::cuda::VertexFan;

namespace hold = trismooth::hold;

namespace {

/// The corners at each vertex, in random order, as threads may have recorded them.
std::vector<std::vector<std::int32_t>> corners_of(const Mesh& mesh, Random& random) {
  std::vector<std::vector<std::int32_t>> corners(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      corners[mesh.triangles[t][i]].push_back(static_cast<std::int32_t>(3 * t + i));
    }
  }
  for (auto& own : corners) {
    random.shuffle(own);
  }
  return corners;
}

TriangleList list_of(const Mesh& mesh) {
  return {mesh.triangles.data()->data(), static_cast<std::int32_t>(mesh.triangles.size())};
}

std::uint8_t reasons_of(const FanPairs& pairs) {
  std::uint8_t reasons = pairs.is_one_fan() ? 0 : hold::bow_tie;
  for (int r = 0; r < 2 * pairs.degree; ++r) {
    reasons |= pairs.partners[r] == FanPairs::none ? hold::boundary : 0;
    reasons |= pairs.partners[r] == FanPairs::many ? hold::non_manifold : 0;
  }
  return reasons;
}

/// Partners are records of the same neighbour, and of the triangles that the host has found to be on one edge.
void require_paired(const TriangleTopology& topology, const TriangleList& triangles, const FanPairs& pairs,
                    const std::vector<std::int32_t>& own) {
  for (int r = 0; r < 2 * pairs.degree; ++r) {
    const std::int32_t corner = own[r / 2];
    // The edge to the neighbour before the vertex is the halfedge that starts at that neighbour.
    const std::int32_t halfedge = r % 2 == 0 ? corner : corner - corner % 3 + (corner % 3 + 2) % 3;
    const std::int32_t twin = topology.twins[halfedge];
    const std::int8_t partner = pairs.partners[r];
    if (twin < 0) {
      REQUIRE(partner == (twin == TriangleTopology::no_twin ? FanPairs::none : FanPairs::many));
    } else {
      REQUIRE(partner >= 0);
      REQUIRE(pairs.partners[partner] == r);
      REQUIRE(own[partner / 2] / 3 == twin / 3);
      REQUIRE(triangles.neighbour(own[partner / 2], partner % 2) == triangles.neighbour(corner, r % 2));
    }
  }
}

/// Returns the number of rings that were compared.
int require_host_results(const Mesh& mesh, Random& random) {
  Workers workers(1);
  const TriangleTopology topology = trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
  const MeshRings found = trismooth::find_mesh_rings(mesh.points, mesh.triangles, {}, workers);
  const TriangleList triangles = list_of(mesh);
  const auto corners = corners_of(mesh, random);
  int rings = 0;
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto& own = corners[v];
    if (own.empty() || own.size() > VertexFan::capacity) {
      continue;
    }
    const VertexFan fan(triangles, own.data(), static_cast<int>(own.size()));
    const FanPairs pairs(fan);
    require_paired(topology, triangles, pairs, own);
    REQUIRE(int{reasons_of(pairs)} == int{topology.hold[v]});
    if (found.rings.is_free(v)) {
      std::vector<std::int32_t> ring(own.size());
      fan.write_ring([&](int k) { return found.reversed[own[k] / 3] != 0; }, ring.data());
      REQUIRE(std::ranges::equal(ring, found.rings[v]));
      ++rings;
    }
  }
  return rings;
}

}  // namespace

TEST_CASE("what one thread finds around a vertex is what the host finds") {
  Random random(1);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    CHECK((require_host_results(mesh, random) > 0) == (name != "no free vertex"));
    for (const std::size_t period : {1U, 2U, 5U}) {
      require_host_results(test_meshes::partly_reversed(test_meshes::shuffled(mesh, period), period), random);
    }
  }
}

TEST_CASE("vertices with as many triangles as one thread looks after") {
  Random random(2);
  for (std::int32_t size = 3; size <= VertexFan::capacity; ++size) {
    CAPTURE(size);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Mesh star = test_meshes::partly_reversed(test_meshes::shuffled(test_meshes::star(size), seed), 2);
      CHECK(require_host_results(star, random) == 1);
      Mesh open = star;
      open.triangles.pop_back();
      CHECK(require_host_results(open, random) == 0);
    }
  }
}

TEST_CASE("a triangle and its copies are no ring") {
  Random random(3);
  const std::vector<test_meshes::Point> points{{0, 0}, {1, 0}, {0, 1}};
  CHECK(require_host_results({points, {{0, 1, 2}, {0, 1, 2}}}, random) == 0);
  CHECK(require_host_results({points, {{0, 1, 2}, {1, 0, 2}}}, random) == 0);
  CHECK(require_host_results({points, {{0, 1, 2}, {1, 0, 2}, {2, 0, 1}}}, random) == 0);
}

TEST_CASE("non-manifold edges and bow ties of every kind") {
  Random random(4);
  int accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    CAPTURE(i);
    const std::int32_t vertices = 4 + random.below(12);
    Mesh mesh;
    mesh.points.resize(static_cast<std::size_t>(vertices));
    for (auto& p : mesh.points) {
      p = {random.between(0, 1), random.between(0, 1)};
    }
    mesh.triangles = test_meshes::random_soup(vertices, 1 + random.below(30), random);
    try {
      require_host_results(mesh, random);
      ++accepted;
    } catch (const trismooth::MeshError&) {
      continue;  // one-sided
    }
  }
  CHECK(accepted > 1000);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/one_rings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/rings/fixed_elements.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using trismooth::OneRings;
using trismooth::Triangle;
using trismooth::TriangleTopology;
using trismooth::Workers;

namespace {

struct Analysed {
  OneRings rings;
  std::vector<std::uint8_t> reversed;
  std::vector<std::uint8_t> hold;
};

Analysed analysed(const Mesh& mesh, int threads = 1) {
  Workers workers(threads);
  const TriangleTopology topology = trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
  const auto reversed = trismooth::orient(topology, mesh.triangles, mesh.points).reversed;
  return {trismooth::one_rings(topology, mesh.triangles, reversed, topology.hold, workers), reversed, topology.hold};
}

double smallest_fixed_quotient(const Mesh& mesh) {
  const Analysed found = analysed(mesh);
  Workers workers(1);
  return trismooth::FixedElements(mesh.triangles, found.reversed, found.hold, workers)
      .smallest_quotient([&](std::int32_t v) { return mesh.points[v]; });
}

/// The triangle in consistent orientation, beginning with its smallest index.
Triangle turned(Triangle t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

}  // namespace

TEST_CASE("a ring runs counter-clockwise from its smallest vertex, and its steps are the vertex's triangles") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    const Mesh mixed = test_meshes::partly_reversed(mesh, 3);
    const auto [rings, reversed, hold] = analysed(mixed);
    REQUIRE(rings.vertex_count() == mesh.vertex_count());
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      REQUIRE(rings.is_free(v) == (hold[v] == 0));
      if (!rings.is_free(v)) {
        REQUIRE(rings[v].empty());
        continue;
      }
      const auto ring = rings[v];
      REQUIRE(ring.front() == *std::ranges::min_element(ring));
      std::set<Triangle> steps;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        steps.insert(turned({v, ring[i], ring[(i + 1) % ring.size()]}));
      }
      std::set<Triangle> incident;
      for (std::size_t t = 0; t < mixed.triangles.size(); ++t) {
        const auto [a, b, c] = mixed.triangles[t];
        if (v == a || v == b || v == c) {
          incident.insert(turned(reversed[t] != 0 ? Triangle{a, c, b} : Triangle{a, b, c}));
        }
      }
      REQUIRE(ring.size() == incident.size());
      REQUIRE(steps == incident);
    }
  }
}

TEST_CASE("the rings of a mesh are the same however its triangles are listed") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(20, 20, 0.3, 1), 2);
  const OneRings expected = analysed(mesh).rings;
  Mesh listed = test_meshes::partly_reversed(mesh, 4);
  std::ranges::reverse(listed.triangles);
  const OneRings found = analysed(listed).rings;
  CHECK(found.offsets == expected.offsets);
  CHECK(found.neighbours == expected.neighbours);
  const naive::Rings naive_rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    REQUIRE(std::ranges::equal(expected[v], naive_rings[v]));
  }
}

TEST_CASE("rings are the same for every number of threads") {
  const Mesh mesh =
      test_meshes::partly_reversed(test_meshes::shuffled(test_meshes::jittered_grid(120, 120, 0.3, 1), 2), 5);
  const OneRings one = analysed(mesh).rings;
  for (const int threads : {2, 3, 8}) {
    const OneRings many = analysed(mesh, threads).rings;
    CHECK(many.offsets == one.offsets);
    CHECK(many.neighbours == one.neighbours);
  }
}

TEST_CASE("the smallest fixed quotient is that of the triangles whose three corners are all fixed") {
  const Mesh mesh = test_meshes::partly_reversed(test_meshes::shuffled(test_meshes::jittered_grid(6, 5, 0.3, 4), 2), 2);
  const auto [rings, reversed, hold] = analysed(mesh);
  double expected = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    if (!rings.is_free(a) && !rings.is_free(b) && !rings.is_free(c)) {
      expected = std::min(
          expected, naive::element_quotient(mesh.points, reversed[t] != 0 ? Triangle{a, c, b} : Triangle{a, b, c}));
    }
  }
  REQUIRE(std::isfinite(expected));
  CHECK(smallest_fixed_quotient(mesh) == expected);

  const Mesh star = test_meshes::star(6);
  CHECK(std::isinf(smallest_fixed_quotient(star)));
}

TEST_CASE("fixed triangles are found by every number of threads") {
  const Mesh mesh = test_meshes::partly_reversed(test_meshes::jittered_grid(200, 200, 0.3, 4), 2);
  test_meshes::Random random(3);
  std::vector<std::uint8_t> fixed(mesh.points.size());
  std::ranges::generate(fixed, [&] { return static_cast<std::uint8_t>(random.below(3)); });
  std::vector<std::uint8_t> reversed(mesh.triangles.size());
  std::ranges::generate(reversed, [&] { return static_cast<std::uint8_t>(random.below(2)); });
  double smallest = std::numeric_limits<double>::infinity();
  std::int64_t inverted = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (fixed[a] != 0 && fixed[b] != 0 && fixed[c] != 0) {
      const double quotient =
          naive::element_quotient(mesh.points, reversed[t] != 0 ? Triangle{a, c, b} : Triangle{a, b, c});
      smallest = std::min(smallest, quotient);
      inverted += quotient > 0 ? 0 : 1;
    }
  }
  const auto position = [&](std::int32_t v) { return mesh.points[v]; };
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    Workers workers(threads);
    const trismooth::FixedElements found(mesh.triangles, reversed, fixed, workers);
    CHECK(found.smallest_quotient(position) == smallest);
    CHECK(found.inverted(position) == inverted);
  }
}

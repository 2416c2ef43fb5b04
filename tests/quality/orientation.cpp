// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/orientation.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "support/test_meshes.h"

using trismooth::Orientation;
using trismooth::Triangle;
using trismooth::TriangleTopology;

namespace {

TriangleTopology connect(const test_meshes::Mesh& mesh) {
  trismooth::Workers workers(1);
  return trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
}

Orientation oriented(const test_meshes::Mesh& mesh) {
  return trismooth::orient(connect(mesh), mesh.triangles, mesh.points);
}

}  // namespace

TEST_CASE("mixed orientation is undone: exactly the reversed triangles are found") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    if (name == "no free vertex" || name == "hopelessly tangled") {
      continue;  // three components of one triangle each; one with more inverted triangles than valid ones
    }
    for (const std::size_t period : {2U, 3U, 7U}) {
      CAPTURE(period);
      const test_meshes::Mesh mixed = test_meshes::partly_reversed(mesh, period);
      const Orientation found = oriented(mixed);
      for (std::size_t t = 0; t < mixed.triangles.size(); ++t) {
        REQUIRE(int{found.reversed[t]} == (t % period == 0 ? 1 : 0));
      }
    }
  }
}

TEST_CASE("reoriented triangles are those listed against the majority of their component") {
  const test_meshes::Mesh grid = test_meshes::jittered_grid(4, 4, 0.2, 1);  // 18 triangles
  CHECK(oriented(grid).reoriented_triangles == 0);
  CHECK(oriented(test_meshes::partly_reversed(grid, 6)).reoriented_triangles == 3);
  CHECK(oriented(test_meshes::partly_reversed(grid, 1)).reoriented_triangles == 0);
  CHECK(oriented(test_meshes::partly_reversed(grid, 1)).reversed == std::vector<std::uint8_t>(18, 1));
  // Three of 18, then all of the second component: none of them is against its component.
  test_meshes::Mesh two =
      test_meshes::together(test_meshes::partly_reversed(grid, 6), test_meshes::partly_reversed(grid, 1), {5, 0});
  CHECK(oriented(two).reoriented_triangles == 3);
}

TEST_CASE("the sign of a component comes from the number of its triangles, not from their area") {
  // A large inverted triangle against two small valid ones: 0 1 2 and 1 0 3 on one edge, and 1 3 4.
  const test_meshes::Mesh mesh{{{0, 0}, {1, 0}, {0.5, -100}, {0.5, -0.1}, {1.2, -0.1}},
                               {{0, 1, 2}, {1, 0, 3}, {1, 3, 4}}};
  const TriangleTopology topology = connect(mesh);
  REQUIRE(topology.parity == std::vector<std::uint8_t>{0, 0, 0});
  REQUIRE(topology.components == 1);
  const Orientation listed = orient(topology, mesh.triangles, mesh.points);
  CHECK(listed.reversed == std::vector<std::uint8_t>{0, 0, 0});
  const test_meshes::Mesh mirrored = test_meshes::partly_reversed(mesh, 1);
  CHECK(oriented(mirrored).reversed == std::vector<std::uint8_t>{1, 1, 1});
}

TEST_CASE("of as many triangles of either sign, the lowest one that is not degenerate is positive") {
  // Both hang below the edge from 0 to 1 where one should be above.
  const std::vector<test_meshes::Point> points{{0, 0}, {1, 0}, {0.5, -2}, {0.4, -1}, {9, 9}};
  CHECK(oriented({points, {{0, 1, 2}, {1, 0, 3}}}).reversed == std::vector<std::uint8_t>{1, 1});
  CHECK(oriented({points, {{1, 0, 3}, {0, 1, 2}}}).reversed == std::vector<std::uint8_t>{0, 0});
  // A degenerate triangle that comes first has no say: it hangs on the edge from 0 to 2 of the one listed clockwise.
  std::vector<test_meshes::Point> more = points;
  more.push_back({0.25, -1});
  const test_meshes::Mesh mesh{more, {{2, 0, 5}, {0, 1, 2}, {1, 0, 3}}};
  REQUIRE(connect(mesh).components == 1);
  REQUIRE(connect(mesh).parity == std::vector<std::uint8_t>{0, 1, 1});
  CHECK(oriented(mesh).reversed == std::vector<std::uint8_t>{0, 1, 1});
}

TEST_CASE("the sign of a nearly degenerate triangle is that of its quality, whichever corner is listed first") {
  // Along a line that no coordinate hits: the first triangle's doubled area is rounded to 0 from one corner on, and to
  // something else from the others on.
  const std::vector<test_meshes::Point> points{{0.016560048004348522, 0.3893983359162275},
                                               {-0.008405357178249775, -0.19764629288106597},
                                               {-0.006412872150660632, -0.15079435417427756},
                                               {0.004771384277554824, 0.11219587631683277}};
  const test_meshes::Mesh star{points, {{1, 2, 3}, {1, 3, 0}, {0, 3, 2}}};
  const Orientation expected = oriented(star);
  int positive = 0;
  int negative = 0;
  for (std::size_t t = 0; t < star.triangles.size(); ++t) {
    const auto [a, b, c] = trismooth::canonical_corners(star.triangles[t], expected.reversed[t] != 0);
    const double shape = trismooth::shape(points[a], points[b], points[c]);
    positive += shape > 0 ? 1 : 0;
    negative += shape < 0 ? 1 : 0;
  }
  CHECK(positive >= negative);
  for (int turn = 0; turn < 27; ++turn) {
    test_meshes::Mesh turned = star;
    for (int t = 0, turns = turn; t < 3; ++t, turns /= 3) {
      std::rotate(turned.triangles[t].begin(), turned.triangles[t].begin() + turns % 3, turned.triangles[t].end());
    }
    CAPTURE(turn);
    CHECK(oriented(turned).reversed == expected.reversed);
  }
}

TEST_CASE("a component of degenerate triangles alone keeps the order of its lowest triangle") {
  const test_meshes::Mesh mesh{{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {{0, 1, 2}, {1, 2, 3}}};
  CHECK(oriented(mesh).reversed == std::vector<std::uint8_t>{0, 1});
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/inner_edges.h"

#include <cstdint>
#include <set>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::inner_edges_test {

using Numbers = std::vector<std::int32_t>;

TEST_CASE("edges of exactly two triangles count, wherever their ends and however the triangles are listed") {
  // Two triangles on the edge 0-1, a third on 1-2 of the first, a fourth apart.
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 1, 3}, {2, 1, 4}, {5, 6, 7}};
  InnerEdges edges(triangles, 8);
  CHECK(edges.fraction_between(Numbers{0, 0, 0, 1}) == 0);
  CHECK(edges.fraction_between(Numbers{0, 1, 0, 0}) == 0.5);
  CHECK(edges.fraction_between(Numbers{0, 1, 2, 0}) == 1);
  CHECK(edges.vertices_between(Numbers{0, 0, 0, 1}) == 0);
  CHECK(edges.vertices_between(Numbers{0, 1, 0, 0}) == 2);
  CHECK(edges.vertices_between(Numbers{0, 1, 2, 0}) == 3);
}

TEST_CASE("edges of three triangles and meshes without inner edges have nothing between triangles") {
  const auto mesh = test_meshes::three_on_an_edge();
  InnerEdges three(mesh.triangles, mesh.points.size());
  CHECK(three.fraction_between(Numbers{0, 1, 2}) == 0);
  InnerEdges none({}, 0);
  CHECK(none.fraction_between({}) == 0);
  CHECK(none.vertices_between({}) == 0);
}

TEST_CASE("few vertices between triangles have few edges between them") {
  // What regions.cpp relies on: edges that change are at most three times the vertices that see a change.
  test_meshes::Random random(2);
  for (int round = 0; round < 40; ++round) {
    const auto mesh = test_meshes::jittered_grid(3 + random.below(9), 3 + random.below(9), 0, 1);
    Numbers numbers;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      numbers.push_back(random.below(1 + round / 4) == 0 ? 1 : 0);
    }
    std::set<std::set<std::int32_t>> inner;
    std::set<std::set<std::int32_t>> seen;
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& edge : {std::set{a, b}, std::set{b, c}, std::set{c, a}}) {
        if (!seen.insert(edge).second) {
          inner.insert(edge);
        }
      }
    }
    InnerEdges edges(mesh.triangles, mesh.points.size());
    const double changed = edges.fraction_between(numbers) * static_cast<double>(inner.size());
    CHECK(changed <= 3 * static_cast<double>(edges.vertices_between(numbers)) + 1e-9);
  }
}

}  // namespace trismooth::inner_edges_test

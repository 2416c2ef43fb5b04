// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/repeated_triangles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/test_meshes.h"

using trismooth::find_repeated_triangles;
using trismooth::MixedElement;
using trismooth::RepeatedTriangle;
using trismooth::Triangle;
using trismooth::Workers;

namespace {

/// Looks at every pair.
std::vector<RepeatedTriangle> by_pairs(const std::vector<Triangle>& triangles) {
  std::vector<RepeatedTriangle> repeated;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t first = 0; first < t; ++first) {
      if (std::ranges::is_permutation(triangles[t], triangles[first])) {
        repeated.push_back({static_cast<std::int32_t>(t), static_cast<std::int32_t>(first)});
        break;
      }
    }
  }
  return repeated;
}

}  // namespace

TEST_CASE("triangles of the same three corners are found, in whatever order and however often they are listed") {
  test_meshes::Random random(7);
  for (int round = 0; round < 300; ++round) {
    const std::int32_t vertices = 3 + random.below(10);
    std::vector<Triangle> triangles = test_meshes::random_soup(vertices, 1 + random.below(80), random);
    Workers workers(1 + round % 3);
    REQUIRE(find_repeated_triangles(triangles, workers) == by_pairs(triangles));
  }
}

TEST_CASE("quadrilaterals of the same four sides are found, from whichever corner and in either direction") {
  test_meshes::Random random(8);
  std::size_t copies = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<MixedElement> elements;
    std::vector<std::set<std::set<std::int32_t>>> sides;
    std::vector<RepeatedTriangle> expected;
    for (std::int32_t e = 0; e < 60; ++e) {
      std::array<std::int32_t, 6> vertices{0, 1, 2, 3, 4, 5};
      for (std::int32_t i = 5; i > 0; --i) {
        std::swap(vertices[static_cast<std::size_t>(i)], vertices[static_cast<std::size_t>(random.below(i + 1))]);
      }
      const bool is_triangle = random.below(3) == 0;
      elements.push_back({vertices[0], vertices[1], vertices[2], is_triangle ? -1 : vertices[3]});
      const std::size_t count = is_triangle ? 3 : 4;
      std::set<std::set<std::int32_t>> own;
      for (std::size_t i = 0; i < count; ++i) {
        own.insert({vertices[i], vertices[(i + 1) % count]});
      }
      if (const auto first = std::ranges::find(sides, own); first != sides.end()) {
        expected.push_back({e, static_cast<std::int32_t>(first - sides.begin())});
      }
      sides.push_back(own);
    }
    Workers workers(1 + round % 3);
    REQUIRE(find_repeated_triangles(elements, workers) == expected);
    copies += expected.size();
  }
  CHECK(copies > 1000);
}

TEST_CASE("a large mesh has no repeated triangles, and with one it has one, by any number of threads") {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(150, 150, 0.3, 5);
  const auto count = static_cast<std::int32_t>(mesh.triangles.size());
  const auto [a, b, c] = mesh.triangles[30'001];
  std::vector<Triangle> with_one = mesh.triangles;
  with_one.push_back({b, a, c});
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    CHECK(find_repeated_triangles(mesh.triangles, workers).empty());
    CHECK(find_repeated_triangles(with_one, workers) == std::vector<RepeatedTriangle>{{count, 30'001}});
    CHECK(find_repeated_triangles(std::span<const Triangle>{}, workers).empty());
    CHECK(find_repeated_triangles(with_one, threads).size() == 1);
  }
}

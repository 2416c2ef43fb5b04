// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/space/longitudes.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

using trismooth::Triangle;
using trismooth::unwrap_longitudes;
using trismooth::UnwrappedLongitudes;

namespace longitudes_test {

double wrapped(double longitude) {
  return longitude - 360 * std::floor((longitude + 180) / 360);
}

TEST_CASE("longitudes without a jump make no turns") {
  const UnwrappedLongitudes result =
      unwrap_longitudes(std::vector<double>{10, 20, 190}, std::vector<Triangle>{{0, 1, 2}});
  CHECK(result.turns == std::vector<std::int32_t>{0, 0, 0});
  CHECK(result.cut.empty());
}

TEST_CASE("across the date line they are continuous again, each component from its lowest vertex on") {
  const test_meshes::Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(20, 20, 0.4, 2), 3);
  for (const double west : {100.0, 170.0, -200.0, -350.0}) {
    std::vector<double> longitudes;
    for (const auto& [x, y] : mesh.points) {
      longitudes.push_back(wrapped(west + 150 * x));
    }
    const UnwrappedLongitudes result = unwrap_longitudes(longitudes, mesh.triangles);
    CHECK(result.cut.empty());
    CHECK(result.turns.front() == 0);
    const auto unwrapped = [&](std::size_t v) { return longitudes[v] + 360 * result.turns[v]; };
    for (std::size_t v = 0; v < longitudes.size(); ++v) {
      const double expected = unwrapped(0) + 150 * (mesh.points[v].x - mesh.points[0].x);
      CHECK(std::abs(unwrapped(v) - expected) < 1e-9);
    }
  }
}

TEST_CASE("a mesh round the globe is cut where its longitudes jump, another component is not") {
  std::vector<double> longitudes;
  std::vector<Triangle> triangles;
  constexpr std::int32_t sectors = 12;
  for (std::int32_t i = 0; i < sectors; ++i) {
    longitudes.push_back(-180 + 30.0 * i);
    longitudes.push_back(-165 + 30.0 * i);
    const std::int32_t next = (i + 1) % sectors;
    triangles.push_back({2 * i, 2 * next, 2 * i + 1});
    triangles.push_back({2 * next, 2 * next + 1, 2 * i + 1});
  }
  longitudes.insert(longitudes.end(), {179, -179, 178});
  triangles.push_back({2 * sectors, 2 * sectors + 1, 2 * sectors + 2});
  const UnwrappedLongitudes result = unwrap_longitudes(longitudes, triangles);
  CHECK(result.cut == std::vector<std::int32_t>{22, 23});
  for (std::size_t v = 0; v < 24; ++v) {
    CHECK(result.turns[v] == 0);
  }
  CHECK(result.turns[25] == 1);
}

TEST_CASE("a triangle around the pole is cut") {
  CHECK(unwrap_longitudes(std::vector<double>{-120, 0, 120}, std::vector<Triangle>{{0, 1, 2}}).cut.size() == 1);
}

}  // namespace longitudes_test

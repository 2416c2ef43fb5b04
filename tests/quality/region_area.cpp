// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/region_area.h"

#include <cstdint>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::region_area_test {

TEST_CASE("areas of regions are those of their triangles, wherever the vertices inside are") {
  const test_meshes::Mesh even = test_meshes::jittered_grid(9, 9, 0, 1);
  const test_meshes::Mesh jittered = test_meshes::jittered_grid(9, 9, 0.3, 1);
  const auto areas = [](const test_meshes::Mesh& mesh, std::span<const std::int32_t> regions, std::int32_t count) {
    return trismooth::region_areas({mesh.points, mesh.triangles, {}}, regions, count);
  };
  CHECK(areas(even, {}, 1) == std::vector<double>{1});
  CHECK(std::abs(areas(jittered, {}, 1).front() - 1) < 1e-15);
  std::vector<std::int32_t> regions(even.triangles.size(), 0);
  for (std::size_t t = 0; t < 16; ++t) {
    regions[t] = 1;  // the lowest row of cells
  }
  CHECK(areas(even, regions, 3) == std::vector<double>{0.875, 0.125, 0});
}

TEST_CASE("a reversed triangle counts as the orientation has it") {
  const test_meshes::Mesh mesh{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0, 1, 2}, {1, 2, 3}}};
  const std::vector<std::uint8_t> reversed{0, 1};
  CHECK(trismooth::region_areas({mesh.points, mesh.triangles, reversed}, {}, 1) == std::vector<double>{1});
  CHECK(trismooth::region_areas({mesh.points, mesh.triangles, {}}, {}, 1) == std::vector<double>{0});
}

}  // namespace trismooth::region_area_test

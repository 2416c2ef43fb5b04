// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/region_quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "trismooth/quality/quality_report.h"

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::region_quality_test {

TEST_CASE("the quality of a region is that of a mesh of its triangles alone") {
  const auto mesh = test_meshes::tangled(40, 3);
  test_meshes::Random random(1);
  constexpr std::int32_t regions = 5;
  std::vector<std::int32_t> region_of(mesh.triangles.size());
  // Region 0 is larger than any block, region 3 has no triangle.
  std::ranges::generate(region_of, [&] {
    const std::int32_t region = std::max(random.below(8) - 3, 0);
    return region == 3 ? 0 : region;
  });
  const std::vector<RegionQuality> found = region_quality({mesh.points, mesh.triangles, {}, 0}, region_of, regions, 1);
  REQUIRE(found.size() == regions);
  for (std::int32_t region = 0; region < regions; ++region) {
    CAPTURE(region);
    std::vector<Triangle> own;
    for (std::size_t t = 0; t < region_of.size(); ++t) {
      if (region_of[t] == region) {
        own.push_back(mesh.triangles[t]);
      }
    }
    const auto expected = trismooth::quality_report({mesh.points, own, {}, 0}, {.threads = 1});
    const RegionQuality& quality = found[static_cast<std::size_t>(region)];
    CHECK(quality.triangles == expected.triangles);
    CHECK(quality.inverted == expected.inverted);
    if (own.empty()) {
      CHECK(std::isnan(quality.min_shape));
      CHECK(std::isnan(quality.mean_shape));
      CHECK(std::isnan(quality.min_angle));
      continue;
    }
    CHECK(same_bits(quality.min_shape, expected[Metric::shape].min));
    CHECK(quality.mean_shape == Approx(expected[Metric::shape].mean));
    CHECK(same_bits(quality.min_angle, expected[Metric::min_angle].min));
  }
}

TEST_CASE("regions get the same bits from every number of threads") {
  const auto mesh = test_meshes::jittered_grid(130, 130, 0.4, 4);
  std::vector<std::int32_t> region_of(mesh.triangles.size());
  for (std::size_t t = 0; t < region_of.size(); ++t) {
    region_of[t] = static_cast<std::int32_t>(t % 7 == 0);
  }
  const auto expected = region_quality({mesh.points, mesh.triangles, {}, 0}, region_of, 2, 1);
  for (const int threads : {2, 5}) {
    const auto found = region_quality({mesh.points, mesh.triangles, {}, 0}, region_of, 2, threads);
    for (std::size_t r = 0; r < 2; ++r) {
      CHECK(same_bits(found[r].mean_shape, expected[r].mean_shape));
      CHECK(same_bits(found[r].min_shape, expected[r].min_shape));
      CHECK(same_bits(found[r].min_angle, expected[r].min_angle));
    }
  }
}

}  // namespace trismooth::region_quality_test

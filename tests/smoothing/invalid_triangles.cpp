// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/invalid_triangles.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::invalid_triangles_test {

/// What the quality report says of the result is what the result says of itself.
void require_counted(const std::vector<double>& xy, std::span<const std::int32_t> triangles,
                     const SmoothingResult& result) {
  const auto report = trismooth::quality(xy_points(xy), triangles);
  REQUIRE(result.inverted == report.inverted);
  REQUIRE(result.degenerate == report.degenerate);
}

/// A fan whose middle lies outside, and a triangle of held vertices without area.
struct Folded {
  std::vector<double> xy{0, 0, 4, 0, 4, 1, 1, 1, 1, 4, 0, 4, -3, 6, 8, 0, 9, 0, 10, 0};
  std::vector<std::int32_t> triangles{0, 1, 6, 1, 2, 6, 2, 3, 6, 3, 4, 6, 4, 5, 6, 5, 0, 6, 7, 8, 9};
};

TEST_CASE("a result says what is inverted and without area where nobody asked for an untangling") {
  Folded mesh;
  const SmoothingResult result = trismooth::smooth(xy_points(mesh.xy), mesh.triangles);
  CHECK_FALSE(result.untangling.has_value());
  CHECK(result.inverted == 3);
  CHECK(result.degenerate == 1);
  require_counted(mesh.xy, mesh.triangles, result);
}

TEST_CASE("a plan says it of each call's points, valid ones too") {
  Folded mesh;
  trismooth::SmoothingPlan plan(10, mesh.triangles);
  const std::vector<double> folded = mesh.xy;
  for (const bool is_valid : {false, true, false}) {
    mesh.xy = folded;
    if (is_valid) {
      mesh.xy[12] = 0.5;
      mesh.xy[13] = 0.5;
      mesh.xy[17] = 1;
    }
    const SmoothingResult result = plan.smooth(mesh.xy);
    CHECK((result.inverted + result.degenerate == 0) == is_valid);
    require_counted(mesh.xy, mesh.triangles, result);
  }
}

TEST_CASE("what an untangling turned over is counted as it is turned, and what is held for good as well") {
  Folded mesh;
  SmoothingOptions options;
  options.untangle = Untangle::on;
  const SmoothingResult result = trismooth::smooth(xy_points(mesh.xy), mesh.triangles, {}, options);
  CHECK(result.inverted == 0);
  CHECK(result.degenerate == 1);
  require_counted(mesh.xy, mesh.triangles, result);
}

TEST_CASE("the counts are those of the quality report for every method, of meshes with folds, on any threads") {
  for (int round = 0; round < 6; ++round) {
    const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.9, 100 + round);
    for (const Method method : trismooth::values_of<Method>()) {
      for (const bool guard : {true, false}) {
        CAPTURE(round, method, guard);
        SmoothingOptions options;
        options.method = method;
        options.guard = guard;
        options.max_sweeps = 2;
        options.threads = 1 + round % 3;
        std::vector<double> xy = mesh.xy();
        const SmoothingResult result = trismooth::smooth(xy_points(xy), mesh.indices(), {}, options);
        require_counted(xy, mesh.indices(), result);
      }
    }
  }
}

TEST_CASE("triangles of six nodes are counted by their corners") {
  std::vector<double> xy{0, 0, 4, 0, 4, 1, 1, 1, 1, 4, 0, 4, -3, 6};
  const std::vector<std::int32_t> corners{0, 1, 6, 1, 2, 6, 2, 3, 6, 3, 4, 6, 4, 5, 6, 5, 0, 6};
  std::vector<std::int32_t> nodes;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    const std::int32_t ring = 7 + static_cast<std::int32_t>(t / 3);            // of the side from corner 0 to corner 1
    const std::int32_t spoke = 13 + static_cast<std::int32_t>(t / 3 + 1) % 6;  // from corner 1 to the middle of the fan
    nodes.insert(nodes.end(), {corners[t], corners[t + 1], 6, ring, spoke, 13 + static_cast<std::int32_t>(t / 3)});
  }
  for (int i = 0; i < 6; ++i) {  // rings
    const int next = (i + 1) % 6;
    xy.insert(xy.end(), {(xy[2 * i] + xy[2 * next]) / 2, (xy[2 * i + 1] + xy[2 * next + 1]) / 2});
  }
  for (int i = 0; i < 6; ++i) {  // spokes
    xy.insert(xy.end(), {(xy[2 * i] + xy[12]) / 2, (xy[2 * i + 1] + xy[13]) / 2});
  }
  const SmoothingResult result = trismooth::smooth_quadratic(xy_points(xy), nodes);
  CHECK(result.inverted == 3);
  require_counted(xy, corners, result);
}

}  // namespace trismooth::invalid_triangles_test

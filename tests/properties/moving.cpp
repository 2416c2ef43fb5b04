// SPDX-License-Identifier: BSD-3-Clause
// Meshes that follow whatever their boundary does.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/moving_mesh.h"

#include "catch.h"
#include "properties/for_random_meshes.h"
#include "properties/moved_boundary.h"
#include "support/same_bits.h"

using properties::RandomMesh;
using test_meshes::Point;

TEST_CASE("whatever the boundary does, a mesh follows it to the same bits every time, and says what is inverted") {
  properties::for_random_meshes(1500, [](const RandomMesh& random) -> std::string {
    trismooth::MovingMesh moving(random.mesh.points, random.mesh.indices(), random.constraints());
    const std::vector<std::uint8_t> held = moving.held();
    std::vector<Point> first;
    for (const std::uint64_t seed : {random.seed, random.seed + 1, random.seed}) {
      const std::vector<Point> boundary = properties::moved_boundary(random, held, seed);
      std::vector<Point> points = boundary;
      if (std::ranges::any_of(points, [](Point p) { return !std::isfinite(p.x) || !std::isfinite(p.y); })) {
        continue;  // of meshes as large as numbers are
      }
      const trismooth::FollowResult result = moving.follow(points);
      for (std::size_t v = 0; v < points.size(); ++v) {
        if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y)) {
          return fmt::format("vertex {} is not finite", v);
        }
        if (held[v] != 0 && !same_bits(points[v], boundary[v])) {
          return fmt::format("vertex {} is held and has moved", v);
        }
      }
      const trismooth::QualityReport found = trismooth::quality(points, random.mesh.indices());
      if (result.smoothing.inverted + result.smoothing.degenerate == 0 && found.inverted + found.degenerate > 0) {
        return fmt::format("{} inverted and {} degenerate triangles are not said", found.inverted, found.degenerate);
      }
      if (seed == random.seed && !first.empty() && first != points) {
        return "the same boundary gave another mesh";
      }
      first = first.empty() ? points : first;
    }
    return "";
  });
}

// SPDX-License-Identifier: BSD-3-Clause
#include "support/distorted_meshes.h"

#include <cstdint>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/quality/coarse_boundary.h"
#include "trismooth/quality/quality.h"

#include "catch.h"

namespace trismooth::distorted_meshes_test {

using test_meshes::Mesh;

QualityReport quality_of(const Mesh& mesh) {
  const std::vector<double> xy = mesh.xy();
  return trismooth::quality(trismooth::xy_points(xy), mesh.indices());
}

/// That it fills the unit square with a boundary as fine as the inside.
void check_square(const Mesh& mesh) {
  const QualityReport report = quality_of(mesh);
  CHECK(report[Metric::area].mean * static_cast<double>(report.triangles) == Approx(1).epsilon(1e-9));
  std::vector<std::uint8_t> held;
  for (const auto& p : mesh.points) {
    CHECK((p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1));
    held.push_back(distorted_meshes::is_inside(p) ? 0 : trismooth::hold::boundary);
  }
  CHECK_FALSE(trismooth::find_coarse_boundary({mesh.points, mesh.triangles, {}, 0}, held).any());
}

TEST_CASE("the wave-shaped grid is valid and badly distorted, whatever its size") {
  for (const std::int32_t side : {100, 200}) {
    const Mesh mesh = distorted_meshes::wave(side);
    CHECK(mesh.vertex_count() == side * side);
    const QualityReport report = quality_of(mesh);
    CHECK(report.inverted == 0);
    CHECK(report[Metric::shape].min == Approx(0.004).margin(0.001));
    CHECK(report[Metric::shape].mean == Approx(0.2).margin(0.01));
    check_square(mesh);
  }
}

TEST_CASE("the displaced grid has a few inverted triangles at 45 % of its spacing, none at 20 %") {
  const Mesh mesh = distorted_meshes::displaced(100, 0.45, 1);
  const auto inverted = quality_of(mesh).inverted;
  CHECK(inverted > 0);
  CHECK(inverted < 1000);
  check_square(mesh);
  CHECK(quality_of(distorted_meshes::displaced(100, 0.2, 1)).inverted == 0);
}

TEST_CASE("jittered hexagonal points make about as many vertices as asked for, equilateral ones without jitter") {
  for (const std::int32_t side : {30, 100}) {
    const Mesh mesh = distorted_meshes::hexagonal(side, 0.4, 1);
    CHECK(static_cast<double>(mesh.vertex_count()) == Approx(side * side).epsilon(0.05));
    CHECK(quality_of(mesh).inverted == 0);
    check_square(mesh);
  }
  CHECK(quality_of(distorted_meshes::hexagonal(100, 0, 1))[Metric::shape].mean > 0.97);
}

}  // namespace trismooth::distorted_meshes_test

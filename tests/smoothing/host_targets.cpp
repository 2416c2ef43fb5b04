// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/host_targets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "catch.h"
#include "support/naive_mean_ratio.h"
#include "support/naive_smoothing.h"
#include "support/packed_mesh.h"
#include "support/test_meshes.h"

namespace trismooth::host_targets_test {

using naive::Real;
using test_meshes::PackedMesh;

TEMPLATE_TEST_CASE("what it aims at is what a plain computation finds, bit for bit, by any number of threads", "",
                   float, double) {
  std::vector<test_meshes::NamedMesh> meshes = test_meshes::zoo();
  meshes.push_back({"large", test_meshes::shuffled(test_meshes::jittered_grid(70, 70, 0.5, 9), 10)});
  for (const auto& [name, mesh] : meshes) {
    const MeanRatioOptions options{0.7, name == "large" ? 5 : 0,
                                   name == "annulus" ? TargetShape::input : TargetShape::uniform};
    const naive::Rings naive_rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
    for (const int threads : {1, 2, 5}) {
      CAPTURE(name, threads);
      PackedMesh<TestType> packed(mesh, Form::in_place, threads);
      const auto& rings = packed.rings;
      const auto expected = naive::mean_ratio_aims(packed.working, naive_rings, options);
      const HostTargets<TestType> targets = packed.targets(options);
      const MeanRatioTargets<TestType> view = targets.view();
      if (rings.free_count() > 0) {
        REQUIRE(view.scales->size_weight == expected.scales.size_weight);
        REQUIRE(view.scales->power == expected.scales.power);
      }
      REQUIRE((view.edges != nullptr) == (options.target == TargetShape::input));
      for (std::int32_t v = 0; v < rings.vertex_count(); ++v) {
        const std::int32_t input = rings.input_index[v];
        CAPTURE(v, input);
        if (view.edges != nullptr) {
          REQUIRE(view.edges[v].xx == expected.edges[input].xx);
          REQUIRE(view.edges[v].xy == expected.edges[input].xy);
          REQUIRE(view.edges[v].yy == expected.edges[input].yy);
        }
        if (v < rings.free_count()) {
          REQUIRE(view.largest_shares[v] == expected.largest_shares[input]);
        }
        if (!(expected.inverse_areas[input] == std::numeric_limits<TestType>::infinity())) {
          REQUIRE(view.inverse_areas[v] == expected.inverse_areas[input]);
        }
      }
    }
  }
}

TEST_CASE("aimed at is the mean area of a vertex's triangles, of a fixed vertex those that may change, each once") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    PackedMesh<double> packed(mesh, Form::swap, 2);
    const auto& rings = packed.rings;
    const HostTargets<double> targets = packed.targets({});
    const auto at = [&](std::int32_t v) { return naive::widened(packed.local[v]); };
    std::vector<Real> sums(mesh.points.size());
    std::vector<int> counts(mesh.points.size());
    for (const auto& t : mesh.triangles) {
      if (std::ranges::any_of(t, [&](std::int32_t v) { return packed.found.rings.is_free(v); })) {
        const Real area = naive::doubled_area(at(t[0]), at(t[1]), at(t[2]));
        for (const std::int32_t v : t) {
          sums[v] += std::max(area, 0.0L);
          ++counts[v];
        }
      }
    }
    for (std::int32_t v = 0; v < rings.vertex_count(); ++v) {
      const std::int32_t input = rings.input_index[v];
      CAPTURE(name, input);
      if (sums[input] > 0) {
        REQUIRE(1 / targets.view().inverse_areas[v] ==
                Approx(static_cast<double>(sums[input] / counts[input])).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("the larger means of areas, the looser the growth bound; never below the largest share there was") {
  const MeanRatioMesh mesh{0.01, 1, 2, 4};
  CHECK(growth_bound(5.0, 0.02, mesh) == 5.0);
  // An equilateral triangle of four times the area: doubled area 0.08, squares 2 sqrt(3) times as much.
  CHECK(growth_bound(0.0, 0.02, mesh) == Approx(0.08 * 0.08 * std::sqrt(12.0)));
  CHECK(growth_bound(0.0, 0.001, mesh) == Approx(0.04 * 0.04 * std::sqrt(12.0)));
  CHECK(growth_bound(0.0, 0.0, mesh) == growth_bound(0.0, 0.01, mesh));
  CHECK(inverse_target_area(0.25, mesh) == 4);
  CHECK(inverse_target_area(0.0, mesh) == Approx(100));
}

}  // namespace trismooth::host_targets_test

// SPDX-License-Identifier: BSD-3-Clause
// What tangles a valid mesh is undone, whatever its domain; and where the sweeps follow, nothing is left inverted.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/smooth.h"
#include "trismooth/smoothing/untangle/untangle.h"

#include "catch.h"
#include "support/same_bits.h"
#include "support/tangled_meshes.h"

using namespace tangled_meshes;
using trismooth::Triangle;

namespace {

std::int64_t inverted(const std::vector<Triangle>& triangles, const std::vector<test_meshes::Point>& points) {
  return std::ranges::count_if(triangles, [&](const Triangle& t) {
    return !(trismooth::shape_quotient(points[t[0]], points[t[1]], points[t[2]]) > 0);
  });
}

/// Triangles that are not counter-clockwise, and quadrilaterals with a corner that does not turn to the left.
std::int64_t inverted_elements(const std::vector<trismooth::MixedElement>& elements,
                               const std::vector<test_meshes::Point>& points) {
  return std::ranges::count_if(elements, [&](const trismooth::MixedElement& element) {
    const int corners = element[3] < 0 ? 3 : 4;
    bool turns_left = true;
    for (int i = 0; i < corners; ++i) {
      const test_meshes::Point at = points[element[i]];
      turns_left = turns_left && cross(points[element[(i + 1) % corners]] - at,
                                       points[element[(i + corners - 1) % corners]] - at) > 0;
    }
    return !turns_left;
  });
}

trismooth::OneRings rings_of(const ValidMesh& valid, trismooth::Workers& workers) {
  const auto topology = trismooth::connect_triangles(valid.mesh.vertex_count(), valid.mesh.triangles, workers);
  const std::vector<std::uint8_t> reversed(valid.mesh.triangles.size(), 0);
  return trismooth::one_rings(topology, valid.mesh.triangles, reversed, valid.fixed, workers);
}

}  // namespace

TEST_CASE("every mesh of the generator is valid and has free vertices") {
  for (const Domain domain : all_domains) {
    for (const std::int32_t vertices : {100, 1000}) {
      CAPTURE(name_of(domain), vertices);
      const ValidMesh valid = valid_mesh(domain, vertices, 1);
      CHECK(inverted(valid.mesh.triangles, valid.mesh.points) == 0);
      CHECK(std::ranges::count(valid.fixed, 0) > vertices / 20);
      for (const Tangle tangle : all_tangles) {
        const auto points = tangled_points(valid, tangle, 1);
        CHECK(std::ranges::any_of(points, [&, v = 0](test_meshes::Point p) mutable {
          return !(p == valid.mesh.points[static_cast<std::size_t>(v++)]);
        }));
      }
    }
  }
}

TEST_CASE("tangled meshes of every domain are untangled", "[untangling]") {
  trismooth::Workers workers(2);
  for (const Domain domain : all_domains) {
    for (const Tangle tangle : all_tangles) {
      for (const std::int32_t vertices : {100, 700, 3000}) {
        for (std::uint64_t seed = 0; seed < (vertices == 100 ? 10U : 1U); ++seed) {
          CAPTURE(name_of(domain), name_of(tangle), vertices, seed);
          const ValidMesh valid = valid_mesh(domain, vertices, seed + 1000);
          const trismooth::OneRings rings = rings_of(valid, workers);
          auto points = tangled_points(valid, tangle, seed);
          const std::int64_t before = inverted(valid.mesh.triangles, points);
          const auto outcome = trismooth::untangle(rings.view(), points, workers);
          CHECK(outcome.inverted_before == before);
          CHECK(outcome.inverted_after == 0);
          CHECK(inverted(valid.mesh.triangles, points) == 0);
        }
      }
    }
  }
}

TEST_CASE("tangled quadrilaterals of every domain are untangled, alone and with triangles among them", "[untangling]") {
  trismooth::Workers workers(2);
  for (const Domain domain : all_domains) {
    for (const Tangle tangle : all_tangles) {
      for (const std::int32_t vertices : {30, 100, 500}) {
        CAPTURE(name_of(domain), name_of(tangle), vertices);
        const CutMesh cut = cut_in_quadrilaterals(valid_mesh(domain, vertices, 7));
        const ValidMesh& valid = cut.in_triangles;
        for (const auto& elements : {cut.quadrilaterals, cut.both}) {
          const std::span<const trismooth::MixedElement> listed(elements);
          REQUIRE(inverted_elements(elements, valid.mesh.points) == 0);
          const auto topology = trismooth::connect_triangles(valid.mesh.vertex_count(), listed, workers);
          const std::vector<std::uint8_t> reversed(elements.size(), 0);
          const trismooth::OneRings rings = trismooth::one_rings(topology, listed, reversed, valid.fixed, workers);
          auto points = tangled_points(valid, tangle, 5);
          const std::int64_t before = inverted_elements(elements, points);
          const auto outcome = trismooth::untangle(rings.view(), points, workers);
          CHECK(outcome.inverted_before == before);
          CHECK(outcome.inverted_after == 0);
          CHECK(inverted_elements(elements, points) == 0);
        }
      }
    }
  }
}

TEST_CASE("what is folded as a whole is untangled from few vertices on") {
  trismooth::Workers workers(2);
  for (const Domain domain : {Domain::twisted, Domain::wave, Domain::holes}) {
    CAPTURE(name_of(domain));
    const ValidMesh valid = valid_mesh(domain, 8000, 3);
    const trismooth::OneRings rings = rings_of(valid, workers);
    auto points = tangled_points(valid, Tangle::one_point, 3);
    CHECK(trismooth::untangle(rings.view(), points, workers).inverted_after == 0);
    CHECK(inverted(valid.mesh.triangles, points) == 0);
  }
}

TEST_CASE("the rest is untangled where held vertices fold some places, and nothing is worse than it came") {
  trismooth::Workers workers(2);
  for (const Domain domain : all_domains) {
    CAPTURE(name_of(domain));
    ValidMesh valid = valid_mesh(domain, 2000, 4);
    fold_by_held_vertices(valid, 12, 4);
    const std::int64_t folds = inverted(valid.mesh.triangles, valid.mesh.points);
    CHECK(folds > 0);
    const trismooth::OneRings rings = rings_of(valid, workers);
    auto points = tangled_points(valid, Tangle::many_displaced, 4);
    const auto outcome = trismooth::untangle(rings.view(), points, workers);
    CHECK(outcome.inverted_after <= outcome.inverted_before);
    CHECK(outcome.inverted_after <= folds);
  }
}

TEST_CASE("every share of displaced vertices is untangled") {
  trismooth::Workers workers(2);
  const ValidMesh valid = valid_mesh(Domain::holes, 2000, 5);
  const trismooth::OneRings rings = rings_of(valid, workers);
  for (const double part : {0.01, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    CAPTURE(part);
    auto points = displaced_points(valid, part, 3, 6);
    CHECK(trismooth::untangle(rings.view(), points, workers).inverted_after == 0);
    CHECK(inverted(valid.mesh.triangles, points) == 0);
  }
}

TEST_CASE("sweeps of any method after the untangling leave nothing inverted, with the same bits for all threads") {
  for (const Domain domain : {Domain::square, Domain::comb, Domain::regions, Domain::flat_comb}) {
    for (const Tangle tangle : all_tangles) {
      const ValidMesh valid = valid_mesh(domain, 600, 9);
      Mesh tangled = valid.mesh;
      tangled.points = tangled_points(valid, tangle, 9);
      for (const auto method : {trismooth::Method::smart, trismooth::Method::laplacian}) {
        for (const auto form : {trismooth::Form::swap, trismooth::Form::in_place}) {
          CAPTURE(name_of(domain), name_of(tangle), to_string(method), to_string(form));
          trismooth::SmoothingOptions options;
          options.untangle = trismooth::Untangle::on;
          options.method = method;
          options.form = form;
          options.max_sweeps = 30;
          std::vector<double> expected;
          for (const int threads : {1, 3}) {
            options.threads = threads;
            std::vector<double> xy = tangled.xy();
            const auto result =
                trismooth::smooth(trismooth::xy_points(xy), tangled.indices(), valid.constraints(), options);
            REQUIRE(result.untangling);
            CHECK(result.untangling->inverted_after == 0);
            std::vector<test_meshes::Point> points;
            for (std::size_t v = 0; v < tangled.points.size(); ++v) {
              points.push_back({xy[2 * v], xy[2 * v + 1]});
            }
            CHECK(inverted(valid.mesh.triangles, points) == 0);
            CHECK((expected.empty() || expected == xy));
            expected = xy;
          }
        }
      }
    }
  }
}

#include "trismooth/smoothing/untangle/untangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/smooth.h"
#include "trismooth/smoothing/untangle/untangle_mesh.h"

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Point;
using trismooth::MeshRings;
using trismooth::Triangle;
using trismooth::untangle;
using trismooth::UntangleOutcome;
using trismooth::Workers;

namespace {

/// The rings of a mesh whose triangles are listed as they are to turn.
MeshRings rings_to_untangle(const Mesh& valid, const std::vector<std::int32_t>& fixed_ids = {}) {
  Workers workers(1);
  trismooth::Constraints constraints;
  constraints.fixed_ids = fixed_ids;
  return trismooth::find_mesh_rings(valid.points, valid.triangles, constraints, workers);
}

std::int64_t inverted(const Mesh& mesh, const std::vector<Point>& points) {
  return std::ranges::count_if(mesh.triangles, [&](const Triangle& t) {
    return !(trismooth::shape_quotient(points[t[0]], points[t[1]], points[t[2]]) > 0);
  });
}

/// The free vertices at random places in the unit square.
std::vector<Point> strewn(const Mesh& mesh, const MeshRings& found, std::uint64_t seed) {
  test_meshes::Random random(seed);
  std::vector<Point> points = mesh.points;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double x = random.between(0, 1);
    const double y = random.between(0, 1);
    if (found.fixed[v] == 0) {
      points[v] = {x, y};
    }
  }
  return points;
}

void require_same(const std::vector<Point>& a, const std::vector<Point>& b) {
  REQUIRE(std::ranges::equal(a, b, [](Point p, Point q) { return same_bits(p, q); }));
}

}  // namespace

TEST_CASE("nothing moves where nothing is inverted") {
  const Mesh mesh = test_meshes::jittered_grid(20, 20, 0.3, 1);
  const MeshRings found = rings_to_untangle(mesh);
  Workers workers(2);
  std::vector<Point> points = mesh.points;
  const UntangleOutcome outcome = untangle(found.rings.view(), points, workers);
  CHECK(outcome.inverted_before == 0);
  CHECK(outcome.inverted_after == 0);
  require_same(points, mesh.points);
}

TEST_CASE("a square is untangled from anywhere, and fixed vertices stay") {
  Workers workers(2);
  for (const std::int32_t side : {3, 5, 12, 40}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      CAPTURE(side, seed);
      const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(side, side, 0.3, seed), seed);
      const MeshRings found = rings_to_untangle(mesh);
      for (const bool is_one_point : {false, true}) {
        std::vector<Point> points = strewn(mesh, found, seed);
        for (std::size_t v = 0; v < points.size(); ++v) {
          if (is_one_point && found.fixed[v] == 0) {
            points[v] = {0.5, 0.5};
          }
        }
        const std::int64_t before = inverted(mesh, points);
        const UntangleOutcome outcome = untangle(found.rings.view(), points, workers);
        CHECK(outcome.inverted_before == before);
        CHECK(outcome.inverted_after == 0);
        CHECK(inverted(mesh, points) == 0);
        CHECK(outcome.by_averages + outcome.by_kernels + outcome.by_embedding + outcome.by_energy == before);
        for (std::size_t v = 0; v < points.size(); ++v) {
          REQUIRE((found.fixed[v] == 0 || same_bits(points[v], mesh.points[v])));
        }
      }
    }
  }
}

TEST_CASE("a part that fixed vertices fold stays as it was or better, and the rest is untangled") {
  // All neighbours of one vertex are held, and one of them stands behind the others: the ring sees no place for it.
  Workers workers(2);
  const Mesh mesh = test_meshes::jittered_grid(30, 30, 0.2, 3);
  const std::int32_t middle = 15 * 30 + 15;
  const MeshRings as_given = rings_to_untangle(mesh);
  const auto ring = as_given.rings[middle];
  const std::vector<std::int32_t> held(ring.begin(), ring.end());
  const MeshRings found = rings_to_untangle(mesh, held);
  std::vector<Point> points = strewn(mesh, found, 3);
  const Point across = mesh.points[held[held.size() / 2]];
  points[held[0]] = {2 * across.x - mesh.points[middle].x, 2 * across.y - mesh.points[middle].y};
  const std::int64_t before = inverted(mesh, points);
  const UntangleOutcome outcome = untangle(found.rings.view(), points, workers);
  CHECK(outcome.inverted_after < 20);
  CHECK(outcome.inverted_after > 0);
  CHECK(inverted(mesh, points) < before);
}

TEST_CASE("a domain that fixed vertices have turned inside out ends at once, no worse than it came") {
  Workers workers(2);
  const Mesh mesh = test_meshes::jittered_grid(20, 20, 0.2, 4);
  const MeshRings found = rings_to_untangle(mesh);
  std::vector<Point> points = mesh.points;
  for (Point& p : points) {
    p.x = 1 - p.x;
  }
  const std::vector<Point> input = points;
  const UntangleOutcome outcome = untangle(found.rings.view(), points, workers);
  CHECK(outcome.inverted_before > 0);
  CHECK(outcome.inverted_after <= outcome.inverted_before);
  CHECK(outcome.parts_of_no_area == 1);
}

TEST_CASE("the result does not depend on threads nor on the order of rings in memory, and scales by powers of two") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::annulus(40, 12, 0.4), 5);
  const MeshRings found = rings_to_untangle(mesh);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    CAPTURE(seed);
    std::vector<Point> start = strewn(mesh, found, seed);
    if (seed % 2 == 0) {  // a few out of place alone: the means for parts of the mesh
      for (std::size_t v = 0; v < start.size(); ++v) {
        start[v] = v % 17 == 0 ? start[v] : mesh.points[v];
      }
    }
    std::vector<Point> expected = start;
    Workers one(1);
    const UntangleOutcome outcome = untangle(found.rings.view(), expected, one);
    CHECK(outcome.inverted_before > 0);
    CHECK(outcome.inverted_after == 0);

    Workers four(4);
    std::vector<Point> points = start;
    untangle(found.rings.view(), points, four);
    require_same(points, expected);

    for (const auto form : {trismooth::Form::swap, trismooth::Form::in_place}) {
      const trismooth::PackedRings packed = trismooth::pack_rings(found.rings, start, form, four);
      std::vector<Point> in_order;
      for (const std::int32_t v : packed.input_index) {
        in_order.push_back(start[v]);
      }
      untangle(packed.view(), in_order, four);
      for (std::size_t v = 0; v < in_order.size(); ++v) {
        points[packed.input_index[v]] = in_order[v];
      }
      require_same(points, expected);
    }

    for (const double scale : {0x1p-40, 0x1p30}) {
      points = start;
      for (Point& p : points) {
        p = {scale * p.x, scale * p.y};
      }
      untangle(found.rings.view(), points, four);
      for (Point& p : points) {
        p = {p.x / scale, p.y / scale};
      }
      require_same(points, expected);
    }
  }
}

TEST_CASE("a mesh in which the wrong triangles are in the majority is turned over first") {
  Workers workers(2);
  int turned = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const Mesh mesh = test_meshes::partly_reversed(test_meshes::jittered_grid(15, 15, 0.2, seed), 3);
    // The inside is mirrored: most triangles are inverted.
    const MeshRings found = rings_to_untangle(mesh);
    std::vector<Point> points = strewn(mesh, found, seed);
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (found.fixed[v] == 0 && seed % 2 == 0) {
        points[v] = {1 - mesh.points[v].x, mesh.points[v].y};
      }
    }
    std::vector<double> xy;
    for (const Point p : points) {
      xy.insert(xy.end(), {p.x, p.y});
    }
    for (const bool is_double : {true, false}) {
      trismooth::SmoothingOptions options;
      options.untangle = trismooth::Untangle::on;
      options.precision = is_double ? trismooth::Precision::double_precision : trismooth::Precision::single_precision;
      std::vector<double> smoothed = xy;
      const auto result = trismooth::smooth(trismooth::xy_points(smoothed), mesh.indices(), options);
      REQUIRE(result.untangling);
      CHECK(result.untangling->inverted_before > 0);
      CHECK(result.untangling->inverted_untangled == 0);
      CHECK(result.untangling->inverted_after == 0);
      CHECK(result.untangling->inverted_fixed == 0);
      turned += result.untangling->turned_components;
      std::vector<Point> now;
      for (std::size_t v = 0; v < points.size(); ++v) {
        now.push_back({smoothed[2 * v], smoothed[2 * v + 1]});
      }
      const Mesh as_listed = test_meshes::partly_reversed(mesh, 3);
      CHECK(inverted(as_listed, now) == 0);
    }
  }
  CHECK(turned >= 20);
}

TEST_CASE("untangling is left out where it is not asked for, and changes nothing where nothing is inverted") {
  const Mesh mesh = test_meshes::jittered_grid(12, 12, 0.3, 6);
  std::vector<double> off = mesh.xy();
  std::vector<double> on = off;
  trismooth::SmoothingOptions options;
  CHECK_FALSE(options.untangles());
  const auto without = trismooth::smooth(trismooth::xy_points(off), mesh.indices(), options);
  CHECK_FALSE(without.untangling);
  options.untangle = trismooth::Untangle::on;
  const auto with = trismooth::smooth(trismooth::xy_points(on), mesh.indices(), options);
  REQUIRE(with.untangling);
  CHECK(with.untangling->inverted_before == 0);
  CHECK(with.sweeps == without.sweeps);
  CHECK(on == off);
}

TEST_CASE("triangles that fixed vertices alone have inverted are told apart") {
  Mesh mesh = test_meshes::jittered_grid(6, 6, 0.2, 7);
  // A triangle of its own, folded back over the mesh: an ear of the side at the bottom.
  mesh.triangles.push_back({1, 0, mesh.vertex_count()});
  mesh.points.push_back({0.1, 0.05});
  std::vector<double> xy = mesh.xy();
  trismooth::SmoothingOptions options;
  options.untangle = trismooth::Untangle::on;
  const auto result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), options);
  REQUIRE(result.untangling);
  CHECK(result.untangling->inverted_before == 0);
  CHECK(result.untangling->inverted_fixed == 1);
}

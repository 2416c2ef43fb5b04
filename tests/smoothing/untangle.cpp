// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/untangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trismooth/base/machine/workers.h"
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

/// A grid whose inside is mirrored: most of its triangles are inverted.
Mesh mirrored_inside(std::int32_t side, std::uint64_t seed) {
  Mesh mesh = test_meshes::jittered_grid(side, side, 0.2, seed);
  const MeshRings found = rings_to_untangle(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (found.fixed[v] == 0) {
      mesh.points[v].x = 1 - mesh.points[v].x;
    }
  }
  return mesh;
}

trismooth::SmoothingOptions untangling_options() {
  trismooth::SmoothingOptions options;
  options.untangle = trismooth::Untangle::on;
  return options;
}

TEST_CASE("of several components those are turned over that need it") {
  const std::vector<Mesh> meshes{test_meshes::jittered_grid(8, 8, 0.3, 1), mirrored_inside(9, 2),
                                 test_meshes::tangled(7, 3), mirrored_inside(8, 4)};
  Mesh all;
  for (const Mesh& mesh : meshes) {
    all = test_meshes::together(all, mesh, {0, 0});
  }
  for (const auto method : {trismooth::Method::smart, trismooth::Method::mean_ratio}) {
    CAPTURE(to_string(method));
    trismooth::SmoothingOptions options = untangling_options();
    options.method = method;
    std::vector<double> xy = all.xy();
    const auto result = trismooth::smooth(trismooth::xy_points(xy), all.indices(), options);
    REQUIRE(result.untangling);
    CHECK(result.untangling->turned_components == 2);
    REQUIRE(result.untangling->turned.size() == all.triangles.size());
    CHECK(result.untangling->inverted_after == 0);
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      for (std::size_t t = 0; t < meshes[i].triangles.size(); ++t, ++triangle) {
        CAPTURE(i, t);
        REQUIRE(result.untangling->turned[triangle] == i % 2);
      }
    }
  }
}

TEST_CASE("what was valid and would be inverted keeps a component from being turned over") {
  // An ear of the side at the bottom, of fixed vertices, folded back over the mesh: with most of the inside mirrored it
  // counts as valid.
  Mesh mesh = mirrored_inside(9, 5);
  mesh.triangles.push_back({1, 0, mesh.vertex_count()});
  mesh.points.push_back({0.06, 0.05});
  std::vector<double> xy = mesh.xy();
  const std::vector<Point> before = mesh.points;
  const auto result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), untangling_options());
  REQUIRE(result.untangling);
  CHECK(result.untangling->turned_components == 0);
  CHECK(result.untangling->turned.empty());
  CHECK(result.untangling->inverted_after <= result.untangling->inverted_before);
  std::vector<Point> after;
  for (std::size_t v = 0; v < xy.size(); v += 2) {
    after.push_back({xy[v], xy[v + 1]});
  }
  for (const auto [a, b, c] : mesh.triangles) {  // valid is clockwise here
    const bool was_valid = trismooth::shape_quotient(before[a], before[c], before[b]) > 0;
    CHECK((!was_valid || trismooth::shape_quotient(after[a], after[c], after[b]) > 0));
  }
}

TEST_CASE("a component goes back as a whole where what is stored of it, turned over, would be worse") {
  // Numbers of float are so far apart here that the turned mesh is inverted again in places when it is stored.
  int back = 0;
  int kept = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Mesh mesh = mirrored_inside(12, seed);
    for (Point& p : mesh.points) {
      const double unit = seed % 2 == 0 ? 24 : 2000;
      p = {std::round(unit * p.x) + 0x1p23, std::round(unit * p.y) + 0x1p23};
    }
    std::vector<double> xy = mesh.xy();
    trismooth::SmoothingOptions options = untangling_options();
    options.method = seed % 4 < 2 ? trismooth::Method::smart : trismooth::Method::mean_ratio;
    const auto result = trismooth::plan(mesh.vertex_count(), mesh.indices(), options)
                            .smooth(trismooth::xy_points(xy), trismooth::Storage::float32);
    REQUIRE(result.untangling);
    const bool is_turned = result.untangling->turned_components > 0;
    CHECK(is_turned == !result.untangling->turned.empty());
    std::vector<Point> after;
    for (std::size_t v = 0; v < xy.size(); v += 2) {
      after.push_back({xy[v], xy[v + 1]});
    }
    if (is_turned) {
      ++kept;
      CHECK(inverted(mesh, after) == result.untangling->inverted_after + result.untangling->inverted_fixed);
    } else if (result.untangling->inverted_untangled == 0) {
      ++back;
      CHECK(xy == mesh.xy());
      CHECK(result.moved_vertices == 0);
      CHECK(result.reverted_vertices > 0);
      CHECK(result.untangling->inverted_after == result.untangling->inverted_before);
    }
  }
  CHECK(back >= 5);
  CHECK(kept >= 5);
}

TEST_CASE("a mesh is not turned over by how its triangles are listed, nor by rounding") {
  // No area at all: collinear points, in any order.
  test_meshes::Random random(9);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    Mesh mesh = test_meshes::jittered_grid(5, 5, 0, 1);
    for (Point& p : mesh.points) {
      const double x = random.between(-1, 1);
      p = {x, 0.3 * x};
    }
    std::vector<double> expected;
    for (int turn = 0; turn < 3; ++turn) {
      std::vector<double> xy = mesh.xy();
      const auto result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), untangling_options());
      CHECK(result.untangling->turned_components == 0);
      CHECK((expected.empty() || expected == xy));
      expected = xy;
      for (Triangle& t : mesh.triangles) {
        std::rotate(t.begin(), t.begin() + random.below(3), t.end());
      }
    }
  }
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

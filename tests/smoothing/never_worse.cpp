// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/guard/never_worse.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/rounding.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Point;
using trismooth::Form;
using trismooth::GuardOutcome;
using trismooth::keep_never_worse;
using trismooth::Method;
using trismooth::OneRings;
using trismooth::Precision;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::Storage;
using trismooth::Workers;

namespace {

std::vector<Point> as_points(const std::vector<double>& xy) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    points.push_back({xy[i], xy[i + 1]});
  }
  return points;
}

OneRings rings_of(const Mesh& mesh) {
  Workers workers(1);
  const auto topology = trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
  const std::vector<std::uint8_t> reversed(mesh.triangles.size(), 0);
  return trismooth::one_rings(topology, mesh.triangles, reversed, topology.hold, workers);
}

/// Free vertices elsewhere: most a little, some far.
std::vector<Point> disturbed(const Mesh& mesh, const OneRings& rings, double reach, test_meshes::Random& random) {
  std::vector<Point> points = mesh.points;
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (rings.is_free(v) && random.below(3) > 0) {
      const double distance = random.below(6) == 0 ? reach : reach / 10;
      points[v].x += random.between(-distance, distance);
      points[v].y += random.between(-distance, distance);
    }
  }
  return points;
}

/// Whether a number in float32's normal range is one of its values, told from the digits that float32 does not have: a
/// conversion there and back is what compilers have got wrong.
bool is_float32(double value) {
  return (std::bit_cast<std::uint64_t>(value) & 0x1fffffffU) == 0;
}

/// The contract, element by element, as one sees it who has the two meshes and knows nothing else: no valid element is
/// invalid, and none is both worse than it was and worse than the worst element around the vertices that are elsewhere
/// was. And that everything else kept its bits.
void check_never_worse(const Mesh& mesh, const OneRings& rings, const std::vector<Point>& after) {
  const double threshold = naive::touched_minimum(mesh.triangles, mesh.points, after);
  double smallest_before = std::numeric_limits<double>::infinity();
  double smallest_after = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const double was = naive::element_quotient(mesh.points, t);
    const double is = naive::element_quotient(after, t);
    REQUIRE(std::isfinite(is));
    REQUIRE((!(was > 0) || is > 0));
    REQUIRE((is >= was || is >= threshold));
    smallest_before = std::min(smallest_before, was);
    smallest_after = std::min(smallest_after, is);
  }
  REQUIRE(smallest_after >= smallest_before);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const bool has_moved = !(after[v] == mesh.points[v]);
    REQUIRE((rings.is_free(v) || !has_moved));
    REQUIRE((has_moved || (same_bits(after[v].x, mesh.points[v].x) && same_bits(after[v].y, mesh.points[v].y))));
  }
}

struct Case {
  Method method;
  Form form;
  Precision precision;
  Storage storage;
};

SmoothingOptions options_of(const Case& which, bool guard) {
  SmoothingOptions options;
  options.method = which.method;
  options.form = which.form;
  options.precision = which.precision;
  options.guard = guard;
  options.max_sweeps = 25;
  options.threads = 1;
  return options;
}

/// As a file of float32 coordinates would hold it.
Mesh in_floats(Mesh mesh) {
  for (Point& p : mesh.points) {
    p = {trismooth::rounded_to_float32(p.x), trismooth::rounded_to_float32(p.y)};
  }
  return mesh;
}

struct Totals {
  std::int64_t reverted = 0;
  std::int64_t most_rounds = 0;
  std::int64_t moved = 0;
};

/// One mesh, one way to smooth it: the contract holds, and the guard took back what a naive one takes back.
void check_case(const Mesh& mesh, const Case& which, Totals& totals) {
  const OneRings rings = rings_of(mesh);
  std::vector<double> xy = mesh.xy();
  trismooth::plan(mesh.vertex_count(), mesh.indices(), {}, options_of(which, false)).smooth(xy, which.storage);
  const std::vector<Point> unguarded = as_points(xy);
  xy = mesh.xy();
  const SmoothingResult result =
      trismooth::plan(mesh.vertex_count(), mesh.indices(), {}, options_of(which, true)).smooth(xy, which.storage);
  const std::vector<Point> after = as_points(xy);
  check_never_worse(mesh, rings, after);

  std::vector<Point> expected = unguarded;
  const naive::Guarded guarded = naive::guard(mesh.triangles, mesh.points, expected);
  REQUIRE(after == expected);
  REQUIRE(result.guard_rounds == guarded.rounds);
  REQUIRE(result.reverted_vertices == static_cast<std::int64_t>(guarded.reverted.size()));
  REQUIRE(result.reverted.size() == guarded.reverted.size());
  for (std::size_t i = 0; i < guarded.reverted.size(); ++i) {
    REQUIRE(result.reverted[i].vertex == guarded.reverted[i]);
    REQUIRE(result.reverted[i].position == unguarded[guarded.reverted[i]]);
  }
  std::int64_t moved = 0;
  for (std::size_t v = 0; v < after.size(); ++v) {
    moved += after[v] == mesh.points[v] ? 0 : 1;
  }
  REQUIRE(result.moved_vertices == moved);
  if (which.storage == Storage::float32) {
    REQUIRE(std::ranges::all_of(xy, is_float32));
  }
  totals.reverted += result.reverted_vertices;
  totals.most_rounds = std::max(totals.most_rounds, result.guard_rounds);
  totals.moved += moved;
}

}  // namespace

TEST_CASE("an element offends where it is not valid any more, or worse than it was and than the threshold") {
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  CHECK(trismooth::offends(0.2, 0.0, -1));
  CHECK(trismooth::offends(0.2, -0.1, -1));
  CHECK(trismooth::offends(1e-300, 0.0, 1));
  CHECK(trismooth::offends(0.2, 0.1, 0.15));
  CHECK_FALSE(trismooth::offends(0.2, 0.1, 0.1));
  CHECK_FALSE(trismooth::offends(0.2, 0.2, 0.25));
  CHECK_FALSE(trismooth::offends(-0.2, -0.1, 0));
  CHECK_FALSE(trismooth::offends(-0.1, -0.2, -0.2));
  CHECK(trismooth::offends(-0.1, -0.2, -0.15));
  CHECK_FALSE(trismooth::offends(0, 0, 0.1));
  CHECK(trismooth::offends(0.2, no_number, -1));
  CHECK(trismooth::offends(-0.2, no_number, -1));
}

TEST_CASE("the guard takes back the same vertices in the same rounds as one that looks at every element") {
  test_meshes::Random random(1);
  std::int64_t most_rounds = 0;
  std::int64_t reverted = 0;
  for (int i = 0; i < 60; ++i) {
    for (const auto& [name, mesh] : test_meshes::zoo()) {
      CAPTURE(i, name);
      const OneRings rings = rings_of(mesh);
      const std::vector<Point> disturbed_points = disturbed(mesh, rings, random.between(0, 0.5), random);
      std::vector<Point> expected = disturbed_points;
      const naive::Guarded guarded = naive::guard(mesh.triangles, mesh.points, expected);
      std::vector<Point> after = disturbed_points;
      Workers workers(1 + i % 3);
      const GuardOutcome outcome = keep_never_worse(rings.view(), mesh.points, after, workers);
      REQUIRE(after == expected);
      REQUIRE(outcome.reverted == guarded.reverted);
      REQUIRE(outcome.rounds == guarded.rounds);
      check_never_worse(mesh, rings, after);
      most_rounds = std::max(most_rounds, outcome.rounds);
      reverted += static_cast<std::int64_t>(outcome.reverted.size());
    }
  }
  // Otherwise nothing was proved: one round cascades into the next somewhere.
  CHECK(most_rounds >= 3);
  CHECK(reverted > 1000);
}

TEST_CASE("elements are evaluated from their smallest index on, from whichever vertex they are seen") {
  // The free vertex of a symmetric ring goes to its mirror image: every element becomes as good as another one was, but
  // for rounding, which depends on the corner that comes first.
  test_meshes::Random random(4);
  int reverted = 0;
  constexpr int rings_tried = 2000;
  for (std::uint64_t seed = 0; seed < rings_tried; ++seed) {
    CAPTURE(seed);
    Mesh mesh = test_meshes::star(6, seed);
    for (const std::int32_t right : {1, 2, 6}) {
      // Vertices 1 and 4 on the axis from left to right; 2 and 6 mirrored to 3 and 5.
      const std::int32_t left = right == 1 ? 4 : right == 2 ? 3 : 5;
      mesh.points[left] = {-mesh.points[right].x, mesh.points[right].y};
    }
    mesh.points[0] = {random.between(-0.3, 0.3), random.between(-0.3, 0.3)};
    const Point mirrored{-mesh.points[0].x, mesh.points[0].y};
    const Point free = mesh.points[0];
    mesh = test_meshes::shuffled(mesh, seed);
    std::vector<Point> after = mesh.points;
    std::ranges::replace(after, free, mirrored);
    std::vector<Point> expected = after;
    const naive::Guarded guarded = naive::guard(mesh.triangles, mesh.points, expected);
    Workers workers(1);
    keep_never_worse(rings_of(mesh).view(), mesh.points, after, workers);
    REQUIRE(after == expected);
    reverted += guarded.rounds > 0 ? 1 : 0;
  }
  CHECK(reverted > rings_tried / 50);
  CHECK(reverted < rings_tried);
}

TEST_CASE("the guard does not depend on the number of threads") {
  test_meshes::Random random(2);
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(120, 120, 0.4, 1), 2);
  const OneRings rings = rings_of(mesh);
  const std::vector<Point> disturbed_points = disturbed(mesh, rings, 0.01, random);
  std::vector<Point> expected = disturbed_points;
  const naive::Guarded guarded = naive::guard(mesh.triangles, mesh.points, expected);
  CHECK(guarded.rounds > 1);
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<Point> after = disturbed_points;
    Workers workers(threads);
    const GuardOutcome outcome = keep_never_worse(rings.view(), mesh.points, after, workers);
    CHECK(after == expected);
    CHECK(outcome.reverted == guarded.reverted);
    CHECK(outcome.rounds == guarded.rounds);
  }
}

TEST_CASE("the guard leaves alone what is better, and what did not move") {
  const Mesh mesh = test_meshes::star(6);
  const OneRings rings = rings_of(mesh);
  Workers workers(1);
  std::vector<Point> after = mesh.points;
  CHECK(keep_never_worse(rings.view(), mesh.points, after, workers).rounds == 0);
  after[0] = {0, 0};
  const GuardOutcome outcome = keep_never_worse(rings.view(), mesh.points, after, workers);
  CHECK(outcome.rounds == 0);
  CHECK(outcome.reverted.empty());
  CHECK(after[0] == Point{0, 0});
  after[0] = {5, 5};
  CHECK(keep_never_worse(rings.view(), mesh.points, after, workers).reverted == std::vector<std::int32_t>{0});
  CHECK(after == mesh.points);
}

TEST_CASE("the bar is the worst element around the vertices that stay moved, and rises when others go back") {
  // Two regular hexagons apart from each other. Around vertex 0, which is near a corner, an element of shape 0.1 would
  // get worse: it goes back. Around vertex 7, in the middle, all are equilateral; its move brings one down to 0.6,
  // which is still above 0.1, but that is no excuse any more.
  const Mesh hexagon = test_meshes::star(6);
  const auto count = hexagon.vertex_count();
  Mesh mesh;
  for (const double centre : {0.0, 10.0}) {
    const std::int32_t first = mesh.vertex_count();
    mesh.points.push_back({centre, 0});
    for (int i = 0; i < 6; ++i) {
      const double angle = std::numbers::pi * i / 3;
      mesh.points.push_back({centre + std::cos(angle), std::sin(angle)});
    }
    for (const auto& t : hexagon.triangles) {
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  mesh.points[0].x = 0.93;
  const OneRings rings = rings_of(mesh);
  REQUIRE(rings.is_free(0));
  REQUIRE(rings.is_free(count));
  std::vector<Point> after = mesh.points;
  after[0] = {0.97, 0.0};
  after[count] = {10.6, 0.0};
  std::vector<Point> alone = mesh.points;
  alone[count] = after[count];
  Workers workers(1);
  const GuardOutcome outcome = keep_never_worse(rings.view(), mesh.points, after, workers);
  CHECK(outcome.rounds == 2);
  CHECK(outcome.reverted == std::vector<std::int32_t>{0, count});
  CHECK(after == mesh.points);
  // As if the other vertex had never tried.
  CHECK(keep_never_worse(rings.view(), mesh.points, alone, workers).reverted == std::vector<std::int32_t>{count});
}

TEST_CASE("vertices that go back one after the other, each for the one before it, all go back") {
  // Three rows of points; those of the middle all step over the place of their right neighbour. The last one leaves
  // the mesh, and each that goes back is in the way of the one to its left. A sliver that gets better keeps the bar so
  // low that nothing else offends.
  constexpr std::int32_t columns = 3000;
  Mesh mesh = test_meshes::jittered_grid(columns, 3, 0, 1);
  for (Point& p : mesh.points) {
    p = {p.x * (columns - 1), p.y * 2};
  }
  const OneRings rings = rings_of(mesh);
  const std::int32_t middle = columns;  // the first vertex of that row
  mesh.points[middle + 1].y = 1.9999;
  std::vector<Point> after = mesh.points;
  after[middle + 1].y = 1;
  for (std::int32_t i = 2; i + 1 < columns; ++i) {
    after[middle + i].x += 1.5;
  }
  Workers workers(2);
  const GuardOutcome outcome = keep_never_worse(rings.view(), mesh.points, after, workers);
  CHECK(outcome.rounds == columns - 3);
  CHECK(std::ssize(outcome.reverted) == columns - 3);
  check_never_worse(mesh, rings, after);
}

TEST_CASE("a position that is no number goes back") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::tangled(8, 1), 2);
  const OneRings rings = rings_of(mesh);
  Workers workers(1);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (rings.is_free(v)) {
      std::vector<Point> after = mesh.points;
      after[v].y = std::numeric_limits<double>::quiet_NaN();
      CHECK(keep_never_worse(rings.view(), mesh.points, after, workers).reverted == std::vector<std::int32_t>{v});
      CHECK(after == mesh.points);
    }
  }
}

TEST_CASE("in a domain that is not convex plain averages do damage, and the guard takes it back") {
  const Mesh mesh = test_meshes::annulus(12, 8, 0.6);
  SmoothingOptions options;
  options.method = Method::laplacian;
  options.guard = false;
  std::vector<double> xy = mesh.xy();
  trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), {}, options);
  const std::vector<std::uint8_t> reversed;
  const auto inverted = [&](const std::vector<Point>& points) {
    return trismooth::quality_report({points, mesh.triangles, reversed, 0}).inverted;
  };
  REQUIRE(inverted(mesh.points) == 0);
  REQUIRE(inverted(as_points(xy)) > 0);

  options.guard = true;
  std::vector<double> guarded = mesh.xy();
  const SmoothingResult result = trismooth::smooth(trismooth::xy_points(guarded), mesh.indices(), {}, options);
  CHECK(result.reverted_vertices > 0);
  CHECK(result.guard_rounds > 0);
  const std::vector<Point> after = as_points(guarded);
  CHECK(inverted(after) == 0);
  CHECK(trismooth::smallest_shape({after, mesh.triangles, reversed, 0}) >=
        trismooth::smallest_shape({mesh.points, mesh.triangles, reversed, 0}));
}

TEST_CASE("rounding to a coarse storage is part of what the guard judges") {
  // Cells of one float32 step and a half, far from the origin: a good position is a bad one once it is rounded.
  Totals in_float32;
  Totals in_float64;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(14, 14, 0, seed), seed);
    for (Point& p : mesh.points) {
      p = {p.x * 13 * 3 + 0x1p24, p.y * 13 * 3 + 0x1p24};
    }
    mesh = in_floats(mesh);
    check_case(mesh, {Method::smart, Form::in_place, Precision::double_precision, Storage::float32}, in_float32);
    check_case(mesh, {Method::smart, Form::in_place, Precision::double_precision, Storage::float64}, in_float64);
  }
  CHECK(in_float32.reverted > 100);
  CHECK(in_float64.reverted == 0);
}

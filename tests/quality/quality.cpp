// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"

#include "catch.h"
#include "support/refusal.h"
#include "support/test_meshes.h"

namespace trismooth::quality_test {

using test_support::refusal;

template <class Points, class Triangles>
concept HasQuality = requires(Points&& points, Triangles&& triangles) {
  { quality(std::forward<Points>(points), std::forward<Triangles>(triangles)) } -> std::same_as<QualityReport>;
};
using Pairs = std::vector<std::array<double, 2>>;
using Indices = std::vector<std::int32_t>;
static_assert(HasQuality<Pairs&, Indices&> && HasQuality<const Pairs&, const Indices&>);
static_assert(HasQuality<trismooth::PointView, std::span<const std::uint64_t>>);
// Plain arrays could be pairs or triples, and temporaries are gone before anybody looks.
static_assert(!HasQuality<std::vector<double>&, Indices&> && !HasQuality<std::span<const double>, Indices&>);
static_assert(!HasQuality<Pairs, Indices&> && !HasQuality<Pairs&, Indices>);

/// The shape of a counter-clockwise triangle as the definition has it, in more digits.
double shape_by_definition(const test_meshes::Mesh& mesh, const trismooth::Triangle& t) {
  const auto squared = [](long double x, long double y) { return x * x + y * y; };
  const auto a = mesh.points[t[0]];
  const auto b = mesh.points[t[1]];
  const auto c = mesh.points[t[2]];
  const long double abx = static_cast<long double>(b.x) - a.x;
  const long double aby = static_cast<long double>(b.y) - a.y;
  const long double acx = static_cast<long double>(c.x) - a.x;
  const long double acy = static_cast<long double>(c.y) - a.y;
  const long double sum = squared(abx, aby) + squared(acx, acy) + squared(abx - acx, aby - acy);
  return static_cast<double>(2 * std::numbers::sqrt3_v<long double> * (abx * acy - aby * acx) / sum);
}

void require_equal(const QualityReport& a, const QualityReport& b) {
  REQUIRE(a.triangles == b.triangles);
  REQUIRE(a.inverted == b.inverted);
  REQUIRE(a.degenerate == b.degenerate);
  REQUIRE(a.shape_histogram == b.shape_histogram);
  for (std::size_t m = 0; m < trismooth::all_metrics().size(); ++m) {
    CAPTURE(m);
    REQUIRE(a.metrics[m].min == b.metrics[m].min);
    REQUIRE(a.metrics[m].mean == b.metrics[m].mean);
    REQUIRE(a.metrics[m].max == b.metrics[m].max);
  }
  REQUIRE(a.worst.size() == b.worst.size());
  for (std::size_t i = 0; i < a.worst.size(); ++i) {
    REQUIRE(a.worst[i].element == b.worst[i].element);
    REQUIRE(a.worst[i].shape == b.worst[i].shape);
  }
}

TEST_CASE("the quality of arrays is that of their triangles, and the arrays stay as they are") {
  const test_meshes::Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(12, 9, 0.3, 4), 5);
  const auto before = mesh.points;
  double smallest = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const double shape = shape_by_definition(mesh, t);
    smallest = std::min(smallest, shape);
    sum += shape;
  }
  const QualityReport report = quality(mesh.points, mesh.triangles);
  CHECK(report.triangles == static_cast<std::int64_t>(mesh.triangles.size()));
  CHECK(report.inverted == 0);
  CHECK(report[Metric::shape].min == Approx(smallest).epsilon(1e-13));
  CHECK(report[Metric::shape].mean == Approx(sum / static_cast<double>(mesh.triangles.size())).epsilon(1e-13));
  REQUIRE(report.worst.size() == 10);
  const auto& [worst, shape, centroid, all_fixed, region] = report.worst.front();
  CHECK(shape_by_definition(mesh, mesh.triangles[static_cast<std::size_t>(worst)]) == Approx(smallest).epsilon(1e-13));
  CHECK(mesh.points == before);
}

TEST_CASE("triangles listed in mixed orientation have the quality of those listed alike") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    if (name == "no free vertex") {
      continue;  // three components of one triangle each
    }
    const QualityReport expected = quality(mesh.points, mesh.triangles);
    for (const std::size_t period : {1U, 2U, 5U}) {
      const test_meshes::Mesh mixed = test_meshes::partly_reversed(mesh, period);
      require_equal(quality(mixed.points, mixed.triangles), expected);
    }
  }
}

TEST_CASE("a triangle that is folded over is inverted, however its neighbours are listed") {
  test_meshes::Mesh mesh = test_meshes::star(6);
  mesh.points[0] = {1.5, 0.1};
  const std::int64_t inverted = quality(mesh.points, mesh.triangles).inverted;
  CHECK(inverted > 0);
  CHECK(2 * inverted < static_cast<std::int64_t>(mesh.triangles.size()));
  const auto mixed = test_meshes::partly_reversed(mesh, 2).triangles;
  CHECK(quality(mesh.points, mixed).inverted == inverted);
}

TEST_CASE("a triangle that is listed again is not inverted") {
  const test_meshes::Mesh once = test_meshes::jittered_grid(4, 4, 0.2, 3);
  for (const auto& t : once.triangles) {
    CAPTURE(t);
    test_meshes::Mesh mesh = once;
    mesh.triangles.push_back(t);
    CHECK(quality(mesh.points, mesh.triangles).inverted == 0);
    mesh.triangles.back() = {t[1], t[0], t[2]};
    CHECK(quality(mesh.points, mesh.triangles).inverted == 0);
  }
}

TEST_CASE("arrays of every form have the same quality") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(7, 8, 0.3, 2);
  const QualityReport expected = quality(mesh.points, mesh.triangles);
  const std::vector<double> xy = mesh.xy();
  require_equal(quality(xy_points(xy), mesh.indices()), expected);
  require_equal(quality(xy_points(std::span(xy)), mesh.triangles, {.threads = 3}), expected);
  std::vector<std::array<double, 3>> spatial;
  std::vector<double> triples;
  for (const auto& p : mesh.points) {
    spatial.push_back({p.x, p.y, 4.5});
    triples.insert(triples.end(), {p.x, p.y, 4.5});
  }
  require_equal(quality(spatial, mesh.triangles), expected);
  require_equal(quality(xyz_points(triples), mesh.triangles), expected);
  const std::vector<std::uint64_t> wide(mesh.indices().begin(), mesh.indices().end());
  require_equal(quality(mesh.points, wide), expected);
  CHECK(quality(mesh.points, mesh.triangles, {.worst_count = 3}).worst.size() == 3);
}

TEST_CASE("areas and centroids are in the caller's units, and vertices of no triangle have no say") {
  test_meshes::Mesh mesh{{{0, 0}, {4, 0}, {0, 2}}, {{0, 1, 2}}};
  for (auto& p : mesh.points) {
    p = {0x1p40 + 0x1p10 * p.x, -0x1p41 + 0x1p10 * p.y};
  }
  mesh.points.push_back({1e300, -1e300});
  const QualityReport report = quality(mesh.points, mesh.triangles);
  CHECK(report[Metric::area].min == 4 * 0x1p20);
  CHECK(report.worst.front().centroid.x == Approx(0x1p40 + 0x1p10 * 4 / 3).epsilon(1e-15));
  CHECK(report.worst.front().centroid.y == Approx(-0x1p41 + 0x1p10 * 2 / 3).epsilon(1e-15));
}

TEST_CASE("a mesh of nothing has a report of nothing") {
  const QualityReport report = quality(std::span<const std::array<double, 2>>(), std::span<const std::int32_t>());
  CHECK(report.triangles == 0);
  CHECK(report.worst.empty());
  CHECK(std::isnan(report[Metric::shape].min));
}

TEST_CASE("what is no mesh, or no plane, has no quality, and the message says why") {
  const Pairs points{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const auto of = [&](const std::vector<trismooth::Triangle>& triangles) {
    return refusal([&] { static_cast<void>(quality(points, triangles)); });
  };
  CHECK(of({{0, 1, 2}, {1, 3, 2}}) == "none");
  CHECK(of({{0, 1, 4}}) == "mesh: triangle 0 names vertex 4; vertices are numbered from 0 to 3");
  CHECK(of({{0, 1, 1}}) == "mesh: triangle 0 repeats a vertex");
  const test_meshes::Mesh band = test_meshes::moebius_band(5);
  CHECK_THROWS_AS(quality(band.points, band.triangles), trismooth::MeshError);
  const std::vector<trismooth::Triangle> both{{0, 1, 2}, {1, 3, 2}};
  Pairs broken = points;
  broken[3][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal([&] { static_cast<void>(quality(broken, both)); }) ==
        "mesh: vertex 3 has a coordinate that is not finite");
  const std::vector<std::array<double, 3>> tilted{{0, 0, 0}, {1, 0, 1}, {0, 1, 0}, {1, 1, 1}};
  CHECK(refusal([&] { static_cast<void>(quality(tilted, both)); }).starts_with("mesh: points: z runs from 0 to 1"));
  CHECK(refusal([&] { static_cast<void>(quality(points, both, {.threads = -1})); }).starts_with("argument: "));
}

TEST_CASE("each triangle has its value of each metric, in its place") {
  const test_meshes::Mesh mesh = test_meshes::partly_reversed(test_meshes::jittered_grid(40, 30, 0.5, 4), 2);
  const std::size_t count = mesh.triangles.size();
  std::vector<double> shapes(count, -7);
  std::vector<double> areas(count, -7);
  trismooth::ElementValues values{};
  values[static_cast<std::size_t>(Metric::shape)] = shapes;
  values[static_cast<std::size_t>(Metric::area)] = areas;
  const QualityReport report = quality(mesh.points, mesh.triangles, values, {.threads = 3});
  require_equal(report, quality(mesh.points, mesh.triangles));
  double total = 0;
  for (std::size_t t = 0; t < count; ++t) {
    REQUIRE(std::abs(shapes[t]) == Approx(std::abs(shape_by_definition(mesh, mesh.triangles[t]))).epsilon(1e-12));
    REQUIRE((shapes[t] > 0) == (areas[t] > 0));
    total += areas[t];
  }
  CHECK(total == Approx(1).epsilon(1e-12));  // of the unit square
  CHECK(*std::ranges::min_element(shapes) == report[Metric::shape].min);
  CHECK(*std::ranges::max_element(areas) == report[Metric::area].max);
  shapes.pop_back();
  values[static_cast<std::size_t>(Metric::shape)] = shapes;
  CHECK(refusal([&] { quality(mesh.points, mesh.triangles, values); }) ==
        "argument: the values of shape: " + std::to_string(count - 1) + " places for " + std::to_string(count) +
            " elements");
}

TEST_CASE("triangles analysed once have the quality of those analysed each time") {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(12, 9, 0.3, 4);
  auto triangles = mesh.triangles;
  const trismooth::MeshQuality analysed(mesh.vertex_count(), triangles);
  std::ranges::fill(triangles, trismooth::Triangle{});  // they are copied
  for (int step = 0; step < 3; ++step) {
    require_equal(analysed.report(mesh.points), quality(mesh.points, mesh.triangles));
    for (auto& [x, y] : mesh.points) {
      x += 0.4 * y * y;
    }
  }
  mesh.points.pop_back();
  CHECK(refusal([&] { static_cast<void>(analysed.report(mesh.points)); }) ==
        "argument: points: 107 of them, expected one for each of 108 vertices");
  CHECK(refusal([&] { trismooth::MeshQuality(2, mesh.triangles); }).starts_with("mesh: triangle 0 names vertex"));
}

}  // namespace trismooth::quality_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/vertex_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Point;
using trismooth::BulkVector;
using trismooth::hilbert_order;
using trismooth::OneRings;
using trismooth::Workers;

namespace {

OneRings one_rings_of(const Mesh& mesh) {
  const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  OneRings result = OneRings::with_sizes(mesh.vertex_count(),
                                         [&](std::int32_t v) { return static_cast<std::int64_t>(rings[v].size()); });
  result.neighbours.clear();
  for (const auto& ring : rings) {
    result.neighbours.insert(result.neighbours.end(), ring.begin(), ring.end());
  }
  return result;
}

void check_order(const BulkVector<std::int32_t>& order, const OneRings& rings) {
  std::vector<std::int32_t> sorted(order.begin(), order.end());
  std::ranges::sort(sorted);
  std::vector<std::int32_t> all(static_cast<std::size_t>(rings.vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  CHECK(sorted == all);
  CHECK(std::ranges::is_partitioned(order, [&](std::int32_t v) { return rings.is_free(v); }));
}

}  // namespace

TEST_CASE("the order holds every vertex once, free ones first") {
  Workers workers(1);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    const OneRings rings = one_rings_of(mesh);
    check_order(hilbert_order(mesh.points, rings, workers), rings);
  }
}

TEST_CASE("vertices that follow each other in the order are near each other") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(60, 60, 0.3, 1), 2);
  const OneRings rings = one_rings_of(mesh);
  Workers workers(1);
  const auto order = hilbert_order(mesh.points, rings, workers);
  double length = 0;
  for (std::size_t i = 1; i < 58U * 58U; ++i) {
    const Point a = mesh.points[order[i - 1]];
    const Point b = mesh.points[order[i]];
    length += std::hypot(a.x - b.x, a.y - b.y);
  }
  // Along the curve a step is about the mesh size, 1/59; in the shuffled order it is half the square.
  CHECK(length / (58 * 58) < 1.5 / 59);
}

TEST_CASE("the order does not depend on the number of threads") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(200, 200, 0.3, 1), 2);
  const OneRings rings = one_rings_of(mesh);
  Workers one(1);
  const auto expected = hilbert_order(mesh.points, rings, one);
  for (const int threads : {2, 3, 8}) {
    Workers many(threads);
    CHECK(hilbert_order(mesh.points, rings, many) == expected);
  }
}

TEST_CASE("meshes without extent, along a line or of nothing are ordered, too") {
  Workers workers(1);
  Mesh mesh = test_meshes::jittered_grid(6, 6, 0, 1);
  const OneRings rings = one_rings_of(mesh);
  for (Point& p : mesh.points) {
    p.y = -1;
  }
  check_order(hilbert_order(mesh.points, rings, workers), rings);
  for (Point& p : mesh.points) {
    p.x = 0.5;
  }
  check_order(hilbert_order(mesh.points, rings, workers), rings);
  CHECK(hilbert_order({}, OneRings{}, workers).empty());
}

TEST_CASE("vertices that are nearer to each other than any number tells apart have some order") {
  Workers workers(1);
  const std::vector<Point> points{{0, 0}, {1e-310, 0}, {0, 5e-324}};
  const OneRings rings = OneRings::with_sizes(3, [](std::int32_t) { return std::int64_t{0}; });
  check_order(hilbert_order(points, rings, workers), rings);
}

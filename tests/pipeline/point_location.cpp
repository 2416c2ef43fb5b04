// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/point_location.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/fields/triangle_tree.h"

#include "catch.h"
#include "support/dice.h"
#include "support/test_meshes.h"

using trismooth::corner_areas;
using trismooth::MeshPlace;
using trismooth::nearest_place;
using trismooth::Point2;
using trismooth::PointLocation;
using trismooth::Triangle;
using trismooth::Workers;

namespace point_location_test {

struct Sample {
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> regions;

  explicit Sample(const test_meshes::Mesh& mesh) {
    for (const auto& [x, y] : mesh.points) {
      points.push_back({x, y});
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      triangles.push_back({a, b, c});
    }
  }
  std::array<Point2<double>, 3> corners(std::int32_t triangle) const {
    const auto& [a, b, c] = triangles[static_cast<std::size_t>(triangle)];
    return {points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
            points[static_cast<std::size_t>(c)]};
  }
  Point2<double> at(const MeshPlace& place) const {
    const auto [a, b, c] = corners(place.triangle);
    const auto [u, v, w] = place.weights;
    return {u * a.x + v * b.x + w * c.x, u * a.y + v * b.y + w * c.y};
  }
  std::vector<MeshPlace> places(const std::vector<Point2<double>>& moved, int threads = 1) const {
    std::vector<std::int32_t> vertices(points.size());
    std::iota(vertices.begin(), vertices.end(), 0);
    Workers workers(threads);
    return PointLocation(points, triangles, regions).places_of(vertices, moved, workers);
  }
  double nearest_distance(Point2<double> point, std::int32_t region) const {
    double nearest = 1e300;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (regions.empty() || regions[t] == region) {
        nearest = std::min(nearest, nearest_place(corners(static_cast<std::int32_t>(t)), point).squared_distance);
      }
    }
    return nearest;
  }
};

double distance(Point2<double> a, Point2<double> b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

TEST_CASE("a vertex that is anywhere in the mesh is found there, near its old place or far from it") {
  const Sample sample(test_meshes::jittered_grid(20, 20, 0.45, 3));
  test_meshes::Random dice(5);
  for (const double reach : {0.0, 0.01, 0.1, 1.0}) {
    std::vector<Point2<double>> moved = sample.points;
    for (Point2<double>& point : moved) {
      point.x = std::clamp(point.x + reach * (2 * dice.between(0, 1) - 1), 0.0, 1.0);
      point.y = std::clamp(point.y + reach * (2 * dice.between(0, 1) - 1), 0.0, 1.0);
    }
    const std::vector<MeshPlace> places = sample.places(moved);
    for (std::size_t v = 0; v < moved.size(); ++v) {
      REQUIRE(places[v].triangle >= 0);
      CHECK(corner_areas(sample.corners(places[v].triangle), moved[v]).hold_point());
      CHECK(distance(sample.at(places[v]), moved[v]) < 1e-15);
      const double sum = places[v].weights[0] + places[v].weights[1] + places[v].weights[2];
      CHECK(std::abs(sum - 1) < 1e-15);
    }
  }
}

TEST_CASE("outside of the mesh it is the nearest place that a search over all triangles finds") {
  const Sample sample(test_meshes::jittered_grid(12, 12, 0.45, 3));
  test_meshes::Random dice(6);
  std::vector<Point2<double>> moved;
  for (std::size_t v = 0; v < sample.points.size(); ++v) {
    moved.push_back({4 * dice.between(0, 1) - 1.5, 4 * dice.between(0, 1) - 1.5});
  }
  const std::vector<MeshPlace> places = sample.places(moved);
  for (std::size_t v = 0; v < moved.size(); ++v) {
    REQUIRE(places[v].triangle >= 0);
    CHECK(distance(sample.at(places[v]), moved[v]) ==
          Approx(std::sqrt(sample.nearest_distance(moved[v], 0))).margin(1e-15));
    for (const double weight : places[v].weights) {
      CHECK(weight >= 0);
    }
  }
}

TEST_CASE("a vertex stays in its region") {
  Sample sample(test_meshes::jittered_grid(12, 12, 0.3, 9));
  for (const Triangle& triangle : sample.triangles) {
    double x = 0;
    for (const std::int32_t v : triangle) {
      x += sample.points[static_cast<std::size_t>(v)].x / 3;
    }
    sample.regions.push_back(x < 0.5 ? 0 : 1);
  }
  test_meshes::Random dice(8);
  std::vector<Point2<double>> moved;
  for (std::size_t v = 0; v < sample.points.size(); ++v) {
    moved.push_back({dice.between(0, 1), dice.between(0, 1)});
  }
  const std::vector<MeshPlace> places = sample.places(moved);
  for (std::size_t v = 0; v < moved.size(); ++v) {
    if (std::abs(sample.points[v].x - 0.5) < 0.1) {
      continue;  // may be of both
    }
    const std::int32_t region = sample.points[v].x < 0.5 ? 0 : 1;
    REQUIRE(places[v].triangle >= 0);
    CHECK(sample.regions[static_cast<std::size_t>(places[v].triangle)] == region);
    CHECK(distance(sample.at(places[v]), moved[v]) ==
          Approx(std::sqrt(sample.nearest_distance(moved[v], region))).margin(1e-15));
  }
}

TEST_CASE("listed in either direction, folded or without area: triangles hold what is in them, and nothing loops") {
  Sample sample(test_meshes::jittered_grid(14, 14, 1.5, 4));
  test_meshes::Random dice(10);
  for (Triangle& triangle : sample.triangles) {
    if (dice.between(0, 1) < 0.5) {
      std::swap(triangle[0], triangle[1]);
    }
  }
  sample.triangles.push_back({0, 1, 2});
  sample.points[1] = sample.points[0];
  sample.points[2] = sample.points[0];
  std::vector<Point2<double>> moved;
  for (std::size_t v = 0; v < sample.points.size(); ++v) {
    moved.push_back({1.2 * dice.between(0, 1) - 0.1, 1.2 * dice.between(0, 1) - 0.1});
  }
  const std::vector<MeshPlace> places = sample.places(moved);
  for (std::size_t v = 0; v < moved.size(); ++v) {
    REQUIRE(places[v].triangle >= 0);
    CHECK(distance(sample.at(places[v]), moved[v]) ==
          Approx(std::sqrt(sample.nearest_distance(moved[v], 0))).margin(1e-14));
  }
}

TEST_CASE("places are the same bits for every number of threads") {
  const Sample sample(test_meshes::jittered_grid(80, 80, 0.45, 3));
  test_meshes::Random dice(11);
  std::vector<Point2<double>> moved = sample.points;
  for (Point2<double>& point : moved) {
    point.x += 0.1 * (dice.between(0, 1) - 0.5);
    point.y += 0.1 * (dice.between(0, 1) - 0.5);
  }
  const std::vector<MeshPlace> one = sample.places(moved);
  const std::vector<MeshPlace> many = sample.places(moved, 5);
  for (std::size_t v = 0; v < moved.size(); ++v) {
    CHECK(one[v].triangle == many[v].triangle);
    CHECK(one[v].weights == many[v].weights);
  }
}

TEST_CASE("a vertex of no triangle is nowhere") {
  Sample sample(test_meshes::jittered_grid(3, 3, 0.1, 3));
  sample.points.push_back({0.5, 0.5});
  CHECK(sample.places(sample.points).back().triangle == -1);
}

}  // namespace point_location_test

// SPDX-License-Identifier: BSD-3-Clause
// Meshes that follow their boundary.
#include "trismooth/smoothing/moving_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "support/refusal.h"
#include "support/rotor.h"
#include "support/same_bits.h"
#include "support/says.h"
#include "support/test_meshes.h"

namespace trismooth::moving_mesh_test {

using test_meshes::Mesh;
using test_meshes::Rotor;
using test_meshes::turned;
using test_support::refusal;
using Points = std::vector<Point2<double>>;

constexpr double degree = std::numbers::pi / 180;

SmoothingOptions smoothing_layers() {
  SmoothingOptions options = moving_options();
  options.layers = Layers::smooth;
  return options;
}

TEST_CASE("the same boundary gives the same bits, whatever came before, and by any number of threads") {
  const Rotor rotor;
  const double angle = 25 * degree;
  SmoothingOptions options = smoothing_layers();
  options.threads = 1;
  MovingMesh alone(rotor.mesh.points, rotor.mesh.indices(), options);
  Points expected = rotor.at(angle);
  alone.follow(expected);
  for (const int threads : {2, 3, 7}) {
    options.threads = threads;
    MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), options);
    for (const double before : {40.0, -30.0, 5.0}) {
      Points elsewhere = rotor.at(before * degree);
      moving.follow(elsewhere, before > 0 ? MovingStart::reference : MovingStart::previous);
    }
    Points points = rotor.at(angle);
    moving.follow(points);
    CHECK((points == expected));
    CHECK((moving.points() == expected));
  }
}

TEST_CASE("a square rotor turns by half a turn and no triangle is inverted") {
  const Rotor rotor;
  const TargetShape target = GENERATE(TargetShape::input, TargetShape::uniform);
  SmoothingOptions options = smoothing_layers();
  options.mean_ratio.target = target;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), options);
  double last = 1;
  for (const double degrees : {10.0, 45.0, 90.0, 150.0}) {
    CAPTURE(degrees);
    Points points = rotor.at(degrees * degree);
    const Points boundary = points;
    const FollowResult result = moving.follow(points);
    const QualityReport found = quality(points, rotor.mesh.indices());
    CHECK(found.inverted == 0);
    CHECK(found[Metric::shape].min > 0.1);
    CHECK(result.smoothing.inverted == 0);
    CHECK(result.smoothing.degenerate == 0);
    CHECK(result.invalid_held == 0);
    CHECK(result.mean_relative_shape < last);
    last = result.mean_relative_shape;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (!rotor.is_inside(v)) {
        CHECK(same_bits(points[v], boundary[v]));
      }
    }
  }
}

TEST_CASE("a mesh whose boundary moves as a rigid body moves as one") {
  const Mesh mesh = test_meshes::jittered_grid(17, 17, 0.2, 3);
  MovingMesh moving(mesh.points, mesh.indices());
  Points at_rest = mesh.points;
  moving.follow(at_rest);
  for (const double degrees : {0.0, 30.0, 90.0, 170.0}) {
    CAPTURE(degrees);
    const auto moved = [&](Point2<double> p) {
      const Point2<double> q = turned(p, degrees * degree);
      return Point2<double>{q.x + 300, q.y - 20};
    };
    Points points(mesh.points.size());
    std::ranges::transform(mesh.points, points.begin(), moved);
    const FollowResult result = moving.follow(points);
    CHECK(result.smoothing.inverted == 0);
    double farthest = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const Point2<double> expected = moved(at_rest[v]);
      farthest = std::max(farthest, std::hypot(points[v].x - expected.x, points[v].y - expected.y));
    }
    CHECK(farthest < 0.05 / 16);  // a twentieth of an edge: where sweeps stop depends on the last digits
  }
}

TEST_CASE("a layer on a wall that moves and turns keeps its height") {
  // A floor with a layer of 8 rows, the first of a hundredth of an edge along it.
  constexpr int columns = 41;
  Mesh mesh;
  std::vector<double> heights{0};
  for (double row = 0.0005; heights.back() < 1; row *= heights.size() < 9 ? 1.3 : 1.7) {
    heights.push_back(heights.back() + row);
  }
  const auto rows = static_cast<int>(heights.size());
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.points.push_back({2.0 * i / (columns - 1), heights[j]});
      if (i + 1 < columns && j + 1 < rows) {
        const int v = j * columns + i;
        mesh.triangles.insert(mesh.triangles.end(), {{v, v + 1, v + columns + 1}, {v, v + columns + 1, v + columns}});
      }
    }
  }
  MovingMesh moving(mesh.points, mesh.indices());
  for (const double slope : {0.1, -0.2}) {
    CAPTURE(slope);
    Points points = mesh.points;
    // The floor bends to a bump; the sides stand where they were.
    for (int i = 0; i < columns; ++i) {
      const double x = points[i].x;
      points[i].y += slope * std::pow(std::sin(std::numbers::pi * x / 2), 2);
    }
    const FollowResult result = moving.follow(points);
    CHECK(result.smoothing.layers.kept > 0);
    CHECK(quality(points, mesh.indices()).inverted == 0);
    for (int i = 2; i < columns - 2; ++i) {
      // The distance from the wall, seen along its normal.
      const Point2<double> along{points[i + 1].x - points[i - 1].x, points[i + 1].y - points[i - 1].y};
      const Point2<double> up{points[columns + i].x - points[i].x, points[columns + i].y - points[i].y};
      const double height = (along.x * up.y - along.y * up.x) / std::hypot(along.x, along.y);
      CHECK(height == Approx(heights[1]).epsilon(0.05));
    }
  }
}

TEST_CASE("steps from the last mesh stay valid, and the result says how far vertices have moved") {
  const Rotor rotor;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  Points last = rotor.mesh.points;
  for (int step = 1; step <= 12; ++step) {
    Points points = rotor.at(5 * step * degree);
    const FollowResult result = moving.follow(points, MovingStart::previous);
    CHECK(quality(points, rotor.mesh.indices()).inverted == 0);
    double farthest = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      farthest = std::max(farthest, std::hypot(points[v].x - last[v].x, points[v].y - last[v].y));
    }
    CHECK(result.largest_move == Approx(farthest));
    last = points;
  }
}

TEST_CASE("what a boundary makes impossible is counted, never silent") {
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.2, 5);
  MovingMesh moving(mesh.points, mesh.indices());
  Points points = mesh.points;
  for (int i = 0; i < 9; ++i) {
    points[i].y = 1.5;  // the floor above the ceiling
  }
  const FollowResult result = moving.follow(points);
  // All triangles of the reference are listed counter-clockwise.
  std::int64_t clockwise = 0;
  std::int64_t flat = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point2<double> ab = points[b] - points[a];
    const Point2<double> ac = points[c] - points[a];
    const double area = ab.x * ac.y - ab.y * ac.x;
    clockwise += area < 0 ? 1 : 0;
    flat += area == 0 ? 1 : 0;
  }
  CHECK(clockwise > 0);
  CHECK(result.smoothing.inverted == clockwise);
  CHECK(result.smoothing.degenerate == flat);
  CHECK(result.min_relative_shape < 0);
}

double largest_distance(const Points& one, const Points& other) {
  double largest = 0;
  for (std::size_t v = 0; v < one.size(); ++v) {
    largest = std::max(largest, std::hypot(one[v].x - other[v].x, one[v].y - other[v].y));
  }
  return largest;
}

TEST_CASE("as little as the boundary moves, as little moves the mesh, so that velocities mean something") {
  const Rotor rotor;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  for (const double angle : {3.0, 10.0, 25.0}) {
    Points points = rotor.at(angle * degree);
    REQUIRE(moving.follow(points).smoothing.untangling->inverted_before == 0);
    for (const double step : {1e-2, 1e-4, 1e-6, 1e-8}) {
      Points further = rotor.at(angle * degree + step);
      moving.follow(further);
      CAPTURE(angle, step);
      // A corner of the rotor goes as far as step times how far it is from the middle.
      CHECK(largest_distance(points, further) < 1.5 * step * 0.7 * std::numbers::sqrt2);
    }
  }
}

TEST_CASE(
    "from the last mesh on a boundary that stays leaves the mesh where it is, after a few steps to the last bit") {
  const Rotor rotor;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  Points points = rotor.at(20 * degree);
  moving.follow(points);
  for (int step = 0; step < 20; ++step) {
    moving.follow(points, MovingStart::previous);
  }
  const Points settled = points;
  moving.follow(points, MovingStart::previous);
  CHECK((points == settled));
}

TEST_CASE("a run that was broken off goes on as if it had not been") {
  const Rotor rotor;
  MovingMesh whole(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  MovingMesh again(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  Points last = rotor.at(20 * degree);
  whole.follow(last, MovingStart::previous);
  again.go_on_from(last);
  CHECK((again.points() == last));
  Points expected = rotor.at(22 * degree);
  Points points = rotor.at(22 * degree);
  const double largest_move = whole.follow(expected, MovingStart::previous).largest_move;
  CHECK(again.follow(points, MovingStart::previous).largest_move == largest_move);
  CHECK((points == expected));
  Points few(3);
  CHECK_THROWS_AS(again.go_on_from(few), std::invalid_argument);
  points[0].x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(again.go_on_from(points), MeshError);
  CHECK((again.points() == expected));
}

TEST_CASE("heights of vertices that are told where to be have to be one, those of the others do not matter") {
  const Rotor rotor;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices());
  const Points flat = rotor.at(5 * degree);
  std::vector<std::array<double, 3>> points;
  for (std::size_t v = 0; v < flat.size(); ++v) {
    points.push_back({flat[v].x, flat[v].y, rotor.is_inside(v) ? 7.0 + double(v) : 2.0});
  }
  const std::vector<std::array<double, 3>> given = points;
  CHECK(moving.follow(points).smoothing.inverted == 0);
  for (std::size_t v = 0; v < points.size(); ++v) {
    CHECK(points[v][2] == given[v][2]);
  }
  points = given;
  points[0][2] = 2.5;
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v][0] = rotor.is_inside(v) ? 1e9 : points[v][0];
  }
  CHECK_THROWS_AS(moving.follow(points), MeshError);
}

TEST_CASE("single precision and float points follow as well") {
  const Rotor rotor;
  SmoothingOptions options = smoothing_layers();
  options.precision = Precision::single_precision;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), options);
  std::vector<float> xy;
  for (const Point2<double> p : rotor.at(30 * degree)) {
    xy.insert(xy.end(), {static_cast<float>(p.x), static_cast<float>(p.y)});
  }
  const FollowResult result = moving.follow(xy_points(xy));
  CHECK(result.smoothing.inverted == 0);
  CHECK(quality(xy_points(xy), rotor.mesh.indices()).inverted == 0);
}

TEST_CASE("a step that is taken back has not happened") {
  const Rotor rotor;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  MovingMesh other(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  CHECK_THROWS_AS(moving.take_back(), std::logic_error);
  Points first = rotor.at(4 * degree);
  Points other_first = first;
  moving.follow(first, MovingStart::previous);
  other.follow(other_first, MovingStart::previous);
  Points too_far = rotor.at(60 * degree);
  moving.follow(too_far, MovingStart::previous);
  moving.take_back();
  CHECK((moving.points() == first));
  CHECK_THROWS_AS(moving.take_back(), std::logic_error);
  Points next = rotor.at(7 * degree);
  Points other_next = next;
  const double largest_move = other.follow(other_next, MovingStart::previous).largest_move;
  CHECK(moving.follow(next, MovingStart::previous).largest_move == largest_move);
  CHECK((next == other_next));
  moving.go_on_from(first);
  CHECK_THROWS_AS(moving.take_back(), std::logic_error);
}

TEST_CASE("calls that are refused leave the step before them, and callbacks do not use the mesh that calls them") {
  const Rotor rotor;
  MovingMesh* itself = nullptr;
  int refused = 0;
  SmoothingOptions options = smoothing_layers();
  options.cancel = [&] {
    if (itself != nullptr) {
      Points other = rotor.at(0);
      CHECK_THROWS_AS(itself->follow(other), std::logic_error);
      CHECK_THROWS_AS(itself->go_on_from(other), std::logic_error);
      CHECK_THROWS_AS(itself->take_back(), std::logic_error);
      ++refused;
    }
    return false;
  };
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), options);
  MovingMesh other(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  Points first = rotor.at(4 * degree);
  CHECK(moving.follow(first).is_valid());
  Points second = rotor.at(20 * degree);
  Points expected = second;
  itself = &moving;
  moving.follow(second, MovingStart::previous);
  itself = nullptr;
  CHECK(refused > 0);
  other.go_on_from(first);
  other.follow(expected, MovingStart::previous);
  CHECK((second == expected));
  Points bad = second;
  bad[3].x = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(moving.follow(bad), MeshError);
  bad.pop_back();
  CHECK_THROWS_AS(moving.follow(bad), std::invalid_argument);
  moving.take_back();
  CHECK((moving.points() == first));
}

TEST_CASE("double points that are to be stored as float follow as float points do") {
  const Rotor rotor;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), smoothing_layers());
  std::vector<std::array<float, 2>> narrow;
  Points wide;
  for (const Point2<double> p : rotor.at(30 * degree)) {
    narrow.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
    wide.push_back({narrow.back()[0], narrow.back()[1]});
  }
  moving.follow(narrow);
  moving.follow(wide, MovingStart::reference, Storage::float32);
  for (std::size_t v = 0; v < wide.size(); ++v) {
    CHECK(wide[v].x == narrow[v][0]);
    CHECK(wide[v].y == narrow[v][1]);
  }
}

TEST_CASE("a mesh that moves refuses what it cannot follow, and leaves the points as they were") {
  const Mesh mesh = test_meshes::jittered_grid(5, 5, 0.2, 1);
  MovingMesh moving(mesh.points, mesh.indices());
  Points few(3);
  CHECK_THROWS_AS(moving.follow(few), std::invalid_argument);
  Points broken = mesh.points;
  broken[0].x = std::numeric_limits<double>::quiet_NaN();
  const Points before = broken;
  CHECK_THROWS_AS(moving.follow(broken), MeshError);
  CHECK(same_bits(broken[1], before[1]));

  SmoothingOptions sized = moving_options();
  const std::vector<double> lengths(mesh.points.size(), 1.0);
  sized.mean_ratio.target_lengths = lengths;
  CHECK(says(refusal([&] { (void)MovingMesh(mesh.points, mesh.indices(), sized); }), "sizes of its reference"));
  Constraints slides;
  slides.slide.along = Slide::straight;
  CHECK(says(refusal([&] { (void)MovingMesh(mesh.points, mesh.indices(), slides); }), "without sliding"));

  MovingMesh other = std::move(moving);
  CHECK_THROWS_AS(moving.held(), std::logic_error);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  CHECK(other.held().size() == mesh.points.size());
}

TEST_CASE(
    "cancelled before the first sweep, a mesh that moves leaves the points as they were, and follows afterwards") {
  const Rotor rotor;
  bool is_unwanted = false;
  SmoothingOptions options = smoothing_layers();
  options.cancel = [&] { return is_unwanted; };
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), options);
  Points points = rotor.at(30 * degree);
  const Points before = points;
  is_unwanted = true;
  const FollowResult cancelled = moving.follow(points);
  CHECK(cancelled.smoothing.stop_reason == StopReason::cancelled);
  CHECK(cancelled.smoothing.inverted == -1);
  CHECK(std::isnan(cancelled.min_relative_shape));
  CHECK((points == before));
  is_unwanted = false;
  CHECK(moving.follow(points).smoothing.inverted == 0);
}

}  // namespace trismooth::moving_mesh_test

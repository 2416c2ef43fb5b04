// SPDX-License-Identifier: BSD-3-Clause
// The never-worse guard for moves of the caller's own.
#include "trismooth/smoothing/keep_never_worse.h"

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::keep_never_worse_test {

using test_meshes::Mesh;

/// Six triangles around vertex 0.
const Mesh star = test_meshes::star(6);

std::vector<double> with_centre_at(double x, double y) {
  std::vector<double> xy = star.xy();
  xy[0] = x;
  xy[1] = y;
  return xy;
}

TEST_CASE("a move that makes all triangles better stays, bit by bit") {
  const std::vector<double> before = with_centre_at(0.3, 0.1);
  std::vector<double> after = with_centre_at(0.01, -0.02);
  const std::vector<double> wanted = after;
  const KeptMoves kept = keep_never_worse(xy_points(before), xy_points(after), star.indices());
  CHECK(same_bits(after, wanted));
  CHECK(kept.moved_vertices == 1);
  CHECK(kept.reverted.empty());
  CHECK(kept.held.empty());
  CHECK(kept.rounds == 0);
  CHECK(kept.inverted + kept.degenerate == 0);
}

TEST_CASE("a move that turns a triangle over goes back, and is named with where it had gone") {
  const std::vector<double> before = with_centre_at(0.3, 0.1);
  std::vector<double> after = with_centre_at(5, 0);
  const KeptMoves kept = keep_never_worse(xy_points(before), xy_points(after), star.indices());
  CHECK(same_bits(after, before));
  CHECK(kept.moved_vertices == 0);
  REQUIRE(kept.reverted.size() == 1);
  CHECK(kept.reverted[0].vertex == 0);
  CHECK(kept.reverted[0].position == Point2<double>{5, 0});
  CHECK(kept.rounds == 1);
}

TEST_CASE("a vertex that has gone any distance away goes back, and hides nothing of what has become of others") {
  const Mesh two = test_meshes::together(test_meshes::star(6), test_meshes::star(6), {5, 0});
  std::vector<double> before = two.xy();
  before[0] = 0.1;
  for (const double away : {1e10, 1e100, 1e162, 1e170, 1e300, -1.7e308}) {
    for (const std::size_t far : {std::size_t{7}, std::size_t{8}}) {  // the middle of the other star, and a held corner
      CAPTURE(away, far);
      std::vector<double> after = before;
      after[0] = 2;  // turns triangles over
      after[2 * far] = away;
      const KeptMoves kept = keep_never_worse(xy_points(before), xy_points(after), two.indices());
      CHECK(same_bits(after, before));
      CHECK(kept.moved_vertices == 0);
      CHECK(kept.inverted + kept.degenerate == 0);
      REQUIRE(kept.reverted.size() + kept.held.size() == 2);
      CHECK(kept.reverted.front().vertex == 0);
      CHECK((far == 8 ? kept.held.front() : kept.reverted.back().vertex) == static_cast<std::int32_t>(far));
    }
  }
}

TEST_CASE("what is held goes back, whether the mesh holds it or the constraints do") {
  const std::vector<double> before = with_centre_at(0.3, 0.1);
  std::vector<double> after = with_centre_at(0, 0);
  after[2] *= 1.01;
  CHECK(keep_never_worse(xy_points(before), xy_points(after), star.indices()).held == std::vector<std::int32_t>{1});
  CHECK(same_bits(after, with_centre_at(0, 0)));

  const std::vector<std::int32_t> centre{0};
  const KeptMoves kept = keep_never_worse(xy_points(before), xy_points(after), star.indices(), {.fixed_ids = centre});
  CHECK(kept.held == centre);
  CHECK(same_bits(after, before));
}

TEST_CASE("a triangle that was inverted is mended by a move that mends it, and counted where nothing moves") {
  // A little beyond the side opposite to it.
  const std::vector<double> before =
      with_centre_at(0.55 * (star.points[1].x + star.points[2].x), 0.55 * (star.points[1].y + star.points[2].y));
  std::vector<double> after = before;
  CHECK(keep_never_worse(xy_points(before), xy_points(after), star.indices()).inverted == 1);
  after = with_centre_at(0, 0);
  const KeptMoves kept = keep_never_worse(xy_points(before), xy_points(after), star.indices());
  CHECK(kept.moved_vertices == 1);
  CHECK(kept.inverted == 0);
}

TEST_CASE("what smoothing gives passes as it is, by any number of threads") {
  const Mesh grid = test_meshes::jittered_grid(40, 30, 0.45, 3);
  const std::vector<double> before = grid.xy();
  for (const Method method : values_of<Method>()) {
    std::vector<double> smoothed = before;
    smooth(xy_points(smoothed), grid.indices(), {.method = method});
    for (const int threads : {1, 2, 7}) {
      std::vector<double> after = smoothed;
      const KeptMoves kept = keep_never_worse(xy_points(before), xy_points(after), grid.indices(), {}, threads);
      CHECK(kept.reverted.empty());
      CHECK(kept.held.empty());
      CHECK(same_bits(after, smoothed));
    }
  }
}

TEST_CASE("points of float and of three numbers are taken; their heights stay") {
  std::vector<std::array<float, 3>> before;
  for (const Point2<double> p : star.points) {
    before.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 7.0F});
  }
  auto after = before;
  after[0] = {9.0F, 0.0F, 7.0F};
  CHECK(keep_never_worse(before, after, star.indices()).reverted.size() == 1);
  CHECK(after == before);
  for (auto& point : after) {
    point[2] = 8.0F;
  }
  const auto lifted = after;
  CHECK_THROWS_AS(keep_never_worse(before, after, star.indices()), MeshError);
  CHECK(after == lifted);
}

TEST_CASE("moves that cannot be judged are refused, and nothing is written") {
  const std::vector<double> before = star.xy();
  const auto refused = [&](std::vector<double> after, const Constraints& constraints = {}, int threads = 0) {
    const std::vector<double> given = after;
    const auto call = [&] {
      keep_never_worse(xy_points(before), xy_points(after), star.indices(), constraints, threads);
    };
    std::string message;
    try {
      call();
    } catch (const MeshError& error) {
      message = error.what();
    } catch (const std::invalid_argument& error) {
      message = error.what();
    }
    CHECK(same_bits(after, given));
    return message;
  };
  CHECK(refused(std::vector<double>(12, 0.0)) == "before has 7 points, after 6");
  CHECK(refused(with_centre_at(std::numeric_limits<double>::quiet_NaN(), 0)) ==
        "vertex 0 has a coordinate that is not finite");
  CHECK(refused(before, {.slide = {.along = Slide::straight}}).find("sliding") != std::string::npos);
  CHECK(!refused(before, {}, -1).empty());
  const std::vector<std::int32_t> unknown{7};
  CHECK(!refused(before, {.fixed_ids = unknown}).empty());

  std::vector<float> single(before.size(), 0.0F);
  CHECK_THROWS_AS(keep_never_worse(xy_points(before), xy_points(single), star.indices()), std::invalid_argument);
  std::vector<double> moved = before;
  const std::vector<std::int32_t> no_mesh{0, 1, 9};
  CHECK_THROWS_AS(keep_never_worse(xy_points(before), xy_points(moved), no_mesh), MeshError);
}

}  // namespace trismooth::keep_never_worse_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/methods/weighted_laplacian.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/random_rings.h"

namespace trismooth::weighted_laplacian_test {

using random_rings::RingOf;

TEMPLATE_TEST_CASE("a vertex moves to the mean weighted by edge length where that is better, bit for bit", "", float,
                   double) {
  test_meshes::Random random(1);
  int moves = 0;
  for (int i = 0; i < 5000; ++i) {
    const RingOf<TestType> ring = random_rings::any<TestType>(random);
    const Point2<TestType> here{static_cast<TestType>(random.between(-1, 1)),
                                static_cast<TestType>(random.between(-1, 1))};
    const auto move = WeightedLaplacian::update<TestType>(here, ring);
    const Point2<TestType> expected = naive::updated(trismooth::Method::weighted, here, ring.positions);
    REQUIRE(move.position == expected);
    REQUIRE(move.moved == !(expected == here));
    moves += move.moved ? 1 : 0;
    if (move.moved) {
      REQUIRE(trismooth::worst_quotient(move.position, ring) > trismooth::worst_quotient(here, ring));
      REQUIRE(trismooth::inverted_triangles(move.position, ring) <= trismooth::inverted_triangles(here, ring));
    }
  }
  CHECK(moves > 500);
  CHECK(moves < 4500);
}

TEST_CASE("far neighbours pull more than near ones") {
  // Lengths 1, 4, 3 and 4: two thirds of (1 * -1 + 3 * 3) / 12; with one weight for all it would be two thirds of 1/2.
  const RingOf<double> ring{{{-1, 0}, {0, -4}, {3, 0}, {0, 4}}};
  const Point2<double> target = length_weighted_position<double>({0, 0}, ring);
  CHECK(target.x == Approx(4.0 / 9).epsilon(1e-15));
  CHECK(target.y == 0);
}

TEMPLATE_TEST_CASE("among neighbours at one distance it is two thirds of the way to the plain mean", "", float,
                   double) {
  test_meshes::Random random(2);
  for (int size = 3; size < 12; ++size) {
    RingOf<TestType> ring;
    const Point2<TestType> here{static_cast<TestType>(random.between(-1, 1)),
                                static_cast<TestType>(random.between(-1, 1))};
    for (int i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (i + random.between(0, 0.5)) / size;
      ring.positions.push_back(
          {static_cast<TestType>(here.x + std::cos(angle)), static_cast<TestType>(here.y + std::sin(angle))});
    }
    const auto weighted = length_weighted_position<TestType>(here, ring);
    const auto plain = trismooth::laplacian_position<TestType>(ring);
    const auto margin = 16 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
    CHECK(3 * static_cast<double>(weighted.x - here.x) ==
          Approx(2 * static_cast<double>(plain.x - here.x)).margin(margin));
    CHECK(3 * static_cast<double>(weighted.y - here.y) ==
          Approx(2 * static_cast<double>(plain.y - here.y)).margin(margin));
  }
}

TEST_CASE("in a round ring one step reaches the place where the vertex stays, but for the square of the distance") {
  for (int size = 3; size < 12; ++size) {
    RingOf<double> ring;
    for (int i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.3) / size;
      ring.positions.push_back({std::cos(angle), std::sin(angle)});
    }
    for (const double distance : {1e-1, 1e-2, 1e-3}) {
      const Point2<double> target = length_weighted_position<double>({0.6 * distance, 0.8 * distance}, ring);
      CHECK(squared_length(target) < std::pow(distance, 4) + 1e-30);
    }
  }
}

TEMPLATE_TEST_CASE("where the smallest quality is known, the move is the same", "", float, double) {
  test_meshes::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const RingOf<TestType> ring = random_rings::any<TestType>(random);
    const Point2<TestType> here{static_cast<TestType>(random.between(-1, 1)),
                                static_cast<TestType>(random.between(-1, 1))};
    const auto move = WeightedLaplacian::update<TestType>(here, ring);
    const auto known = WeightedLaplacian::update<TestType>(here, ring, trismooth::worst_quotient(here, ring));
    REQUIRE(move.moved == known.moved);
    REQUIRE(move.position == known.position);
  }
}

TEMPLATE_TEST_CASE("a vertex on a neighbour leaves it, one with all neighbours in its place stays", "", float, double) {
  const RingOf<TestType> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const auto move = WeightedLaplacian::update<TestType>({1, 1}, square);
  CHECK(move.moved);
  CHECK(trismooth::worst_quotient(move.position, square) > 0);
  const RingOf<TestType> nowhere{{{1, 1}, {1, 1}, {1, 1}}};
  CHECK_FALSE(WeightedLaplacian::update<TestType>({1, 1}, nowhere).moved);
}

TEST_CASE("a random mesh gets better by weighted smoothing, and its worst element does without the guard, too") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(60, 60, 0.35, 5);
  for (const auto form : {trismooth::Form::swap, trismooth::Form::in_place}) {
    CAPTURE(to_string(form));
    std::vector<double> xy = mesh.xy();
    const auto before = trismooth::quality(trismooth::xy_points(xy), mesh.indices())[trismooth::Metric::shape];
    trismooth::SmoothingOptions options;
    options.method = trismooth::Method::weighted;
    options.form = form;
    options.guard = form == trismooth::Form::swap;
    trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), {}, options);
    const auto after = trismooth::quality(trismooth::xy_points(xy), mesh.indices())[trismooth::Metric::shape];
    CHECK(after.mean > before.mean + 0.05);
    CHECK(after.min >= before.min);
  }
}

}  // namespace trismooth::weighted_laplacian_test

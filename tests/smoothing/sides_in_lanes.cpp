#include "trismooth/smoothing/sweeps/sides_in_lanes.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/sweeps/gathered_ring.h"

#include "catch.h"
#include "support/test_meshes.h"

using trismooth::MeanRatioScales;
using trismooth::MeanRatioStep;
using trismooth::MeanRatioTargets;
using trismooth::Point2;
using trismooth::RingGatherer;

namespace {

/// A ring that knows of no lanes.
template <class T>
struct PlainRing {
  const std::vector<Point2<T>>& points;
  const std::vector<std::int32_t>& numbers;

  int size() const { return static_cast<int>(numbers.size()); }
  Point2<T> operator[](int i) const { return points[static_cast<std::size_t>(number(i))]; }
  std::int32_t number(int i) const { return numbers[static_cast<std::size_t>(i)]; }
};

}  // namespace

TEMPLATE_TEST_CASE("the sides of a ring in lanes give the bits that they give one after the other", "", float, double) {
  using T = TestType;
  test_meshes::Random random(11);
  const auto number = [&](double low, double high) { return static_cast<T>(random.between(low, high)); };
  RingGatherer<T> gatherer;
  int moved = 0;
  for (int i = 0; i < 20000; ++i) {
    const int size = 3 + i % 10;
    // Vertex 0 and its ring: star-shaped around it as a rule, so that most have an energy.
    std::vector<Point2<T>> points{{number(-0.3, 0.3), number(-0.3, 0.3)}};
    std::vector<std::int32_t> ring;
    std::vector<T> inverse_areas{number(0.5, 2)};
    std::vector<trismooth::EdgeTensor<T>> edges{{1, number(-0.2, 0.2), 1}};
    for (std::int32_t k = 0; k < size; ++k) {
      const double angle = 2 * std::numbers::pi * (k + random.between(0, 0.6)) / size;
      const double radius = random.between(0.6, 1.6);
      points.push_back({static_cast<T>(radius * std::cos(angle)), static_cast<T>(radius * std::sin(angle))});
      ring.push_back(k + 1);
      inverse_areas.push_back(number(0.5, 2));
      edges.push_back({number(0.5, 2), number(-0.2, 0.2), number(0.5, 2)});
    }
    const T largest_share = i % 4 == 0 ? number(0.1, 4) : std::numeric_limits<T>::infinity();
    const MeanRatioScales<T> scales{number(0, 0.4), 1 + i % 5, i % 7 == 0 ? number(0, 0.2) : T(0)};
    const MeanRatioStep<T> step{i % 3 == 0 ? T(1.5) : T(1.8), static_cast<T>(3e-4), i % 2 == 0};
    MeanRatioTargets<T> targets{inverse_areas.data(), &largest_share, &scales};
    targets.edges = i % 5 == 0 ? edges.data() : nullptr;
    trismooth::visit_mean_ratio(targets, step, [&](const auto& method) {
      const auto in_turn = method.vertex_move(0, points[0], PlainRing<T>{points, ring});
      const auto in_lanes = gatherer.with_ring(std::span<const Point2<T>>(points), ring, [&](const auto& gathered) {
        return method.vertex_move(0, points[0], gathered);
      });
      CAPTURE(i, size);
      REQUIRE(in_lanes.move.moved == in_turn.move.moved);
      REQUIRE(in_lanes.move.position == in_turn.move.position);
      REQUIRE((!in_turn.move.moved || in_lanes.squares == in_turn.squares));
      moved += in_turn.move.moved ? 1 : 0;
    });
  }
  CHECK(moved > 10000);
}

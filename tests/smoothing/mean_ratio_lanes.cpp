// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/mean_ratio_lanes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/smoothing/methods/methods.h"

#include "catch.h"
#include "support/limited_instructions.h"
#include "support/sanitized.h"
#include "support/test_meshes.h"

namespace trismooth::mean_ratio_lanes_test {

/// A ring that knows of no lanes.
template <class T>
struct PlainRing {
  std::span<const Point2<T>> points;
  std::span<const std::int32_t> numbers;

  int size() const { return static_cast<int>(numbers.size()); }
  Point2<T> operator[](int i) const { return points[static_cast<std::size_t>(number(i))]; }
  std::int32_t number(int i) const { return numbers[static_cast<std::size_t>(i)]; }
};

/// That of quadrilaterals.
template <class T>
struct PlainMixedRing {
  std::span<const Point2<T>> points;
  trismooth::MixedRingNumbers numbers;

  int size() const { return numbers.size(); }
  Point2<T> operator[](int i) const { return points[static_cast<std::size_t>(number(i))]; }
  std::int32_t number(int i) const { return numbers[i]; }
  bool is_quadrilateral(int i) const { return numbers.is_quadrilateral(i); }
};

/// Vertices with rings of their own: star-shaped around them as a rule, so that most have an energy.
template <class T>
struct Stars {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> opposites;  ///< of quadrilaterals
  std::vector<Point2<T>> points;
  std::vector<T> inverse_areas;
  std::vector<T> largest_shares;
  std::vector<trismooth::EdgeTensor<T>> edges;

  Stars(std::int32_t count, int size, RingKind kind, bool bounds_growth, test_meshes::Random& random) {
    const auto number = [&](double low, double high) { return static_cast<T>(random.between(low, high)); };
    const auto add = [&](Point2<T> point) {
      points.push_back(point);
      inverse_areas.push_back(number(0.5, 2));
      edges.push_back({number(0.5, 2), number(-0.2, 0.2), number(0.5, 2)});
    };
    for (std::int32_t v = 0; v < count; ++v) {
      add({number(-0.3, 0.3), number(-0.3, 0.3)});
      largest_shares.push_back(bounds_growth ? number(0.1, 4) : std::numeric_limits<T>::infinity());
    }
    for (std::int32_t v = 0; v < count; ++v) {
      const auto add_around = [&](double turn, double scale) {
        const double angle = 2 * std::numbers::pi * (turn + random.between(0, 0.6)) / size;
        const double radius = scale * random.between(0.6, 1.6);
        add({static_cast<T>(radius * std::cos(angle)), static_cast<T>(radius * std::sin(angle))});
        return static_cast<std::int32_t>(points.size()) - 1;
      };
      for (int k = 0; k < size; ++k) {
        neighbours.push_back(add_around(k, 1));
      }
      for (int k = 0; k < size && kind == RingKind::quadrilaterals; ++k) {
        opposites.push_back(add_around(k + 0.5, 1.5));
      }
      offsets.push_back(static_cast<std::int64_t>(neighbours.size()));
    }
  }

  RingView rings() const { return {offsets, neighbours, {}, opposites}; }

  template <class Method>
  VertexMove<T> alone(const Method& method, std::int32_t v) const {
    return rings().has_quadrilaterals() ? method.vertex_move(v, points[v], PlainMixedRing<T>{points, rings().mixed(v)})
                                        : method.vertex_move(v, points[v], PlainRing<T>{points, rings()[v]});
  }
};

TEMPLATE_TEST_CASE(
    "vertices that the mean-ratio method visits in lanes get the bits that each gets alone, by all instructions", "",
    float, double) {
  using T = TestType;
  const InstructionSet most = GENERATE(InstructionSet::baseline, InstructionSet::avx2);
  const LimitedInstructions limited(most);
  constexpr int count = 37;  // more than are found at a time, and rests of every size
  test_meshes::Random random(11);
  int moved = 0;
  int stayed = 0;
  for (int i = 0; i < (is_sanitized ? 400 : 4000); ++i) {
    const int size = 3 + i % 16;
    const RingKind kind = i % 8 < 4 ? RingKind::triangles : RingKind::quadrilaterals;
    const Stars<T> stars(count, size, kind, i % 4 == 0, random);
    const MeanRatioScales<T> scales{static_cast<T>(random.between(0, 0.4)), 1 + i % 5,
                                    i % 7 == 0 ? static_cast<T>(random.between(0, 0.2)) : T(0)};
    const MeanRatioStep<T> step{i % 3 == 0 ? T(1.5) : T(1.8), static_cast<T>(3e-4), i % 2 == 0};
    MeanRatioTargets<T> targets{stars.inverse_areas.data(), stars.largest_shares.data(), &scales};
    targets.edges = i % 5 == 0 ? stars.edges.data() : nullptr;
    trismooth::UpdateOf<trismooth::Method::mean_ratio>::visit(
        trismooth::MethodInUse<T>{Method::mean_ratio, targets, step}, [&](const auto& method) {
          const RingView rings = stars.rings();
          trismooth::VertexVisits<T, std::remove_cvref_t<decltype(method)>> visits(method, rings, stars.points);
          std::vector<std::int32_t> vertices(static_cast<std::size_t>(1 + i % count));
          std::iota(vertices.begin(), vertices.end(), 0);
          std::vector<VertexMove<T>> found(vertices.size());
          visits.visit(vertices, size, kind, [&](std::int32_t v, Point2<T> target, T squares) {
            REQUIRE(!found[v].move.moved);
            found[v] = {{target, true}, squares};
          });
          for (const std::int32_t v : vertices) {
            CAPTURE(i, size, v);
            const VertexMove<T> alone = stars.alone(method, v);
            REQUIRE(found[v].move.moved == alone.move.moved);
            REQUIRE((!alone.move.moved || found[v].move.position == alone.move.position));
            REQUIRE((!alone.move.moved || found[v].squares == alone.squares));
            ++(alone.move.moved ? moved : stayed);
          }
        });
  }
  CHECK(moved > (is_sanitized ? 1000 : 10000));
  CHECK(stayed > (is_sanitized ? 10 : 100));
}

}  // namespace trismooth::mean_ratio_lanes_test

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "trismooth/smoothing/methods/methods.h"

#include "catch.h"
#include "support/naive_mean_ratio.h"
#include "support/naive_smoothing.h"
#include "support/sanitized.h"
#include "support/test_meshes.h"

namespace trismooth::mean_ratio_test {

using naive::Real;

/// A vertex, number 0, in a ring, numbers 1, 2, ..., and what the method aims at there.
template <class T>
struct Scene {
  std::vector<Point2<T>> positions;  ///< of the ring
  Point2<T> position{0, 0};
  std::vector<T> inverse_areas;  ///< by number
  T largest_share = std::numeric_limits<T>::infinity();
  MeanRatioScales<T> scales;
  std::vector<trismooth::EdgeTensor<T>> edges;  ///< by number, or none

  int size() const { return static_cast<int>(positions.size()); }
  Point2<T> operator[](int i) const { return positions[static_cast<std::size_t>(i)]; }
  static std::int32_t number(int i) { return i + 1; }

  Move<T> visit(const MeanRatioStep<T>& step) const {
    MeanRatioTargets<T> targets{inverse_areas.data(), &largest_share, &scales};
    if (!edges.empty()) {
      targets.edges = edges.data();
    }
    return trismooth::UpdateOf<trismooth::Method::mean_ratio>::visit(
        trismooth::MethodInUse<T>{Method::mean_ratio, targets, step},
        [&](const auto& method) { return method.update(0, position, *this); });
  }

  /// The same as its definition sees it.
  naive::EnergyRing energy(bool is_last) const {
    naive::EnergyRing ring;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      ring.positions.push_back(naive::widened(positions[i]));
      ring.inverse_areas.push_back(static_cast<Real>(inverse_areas[i + 1]));
      if (!edges.empty()) {
        ring.edges.push_back(widened(edges[i + 1]));
      }
    }
    ring.own_edges = edges.empty() ? naive::Tensor{} : widened(edges[0]);
    ring.own_inverse_area = static_cast<Real>(inverse_areas[0]);
    ring.third_of_weight = static_cast<Real>(scales.size_weight);
    ring.power = is_last ? scales.power : 1;
    return ring;
  }
  static naive::Tensor widened(const trismooth::EdgeTensor<T>& tensor) {
    return {static_cast<Real>(tensor.xx), static_cast<Real>(tensor.xy), static_cast<Real>(tensor.yy)};
  }
};

/// Round enough for the origin to see all of it; with areas to be aimed at about those that there are.
template <class T>
Scene<T> star(test_meshes::Random& random, bool has_edges) {
  Scene<T> scene;
  const std::int32_t size = 3 + random.below(9);
  const auto around = [&](double spread) {
    std::vector<Point2<T>> places;
    for (std::int32_t i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (i + random.between(-spread, spread)) / size;
      const double radius = random.between(0.4, 1.6);
      places.push_back({static_cast<T>(radius * std::cos(angle)), static_cast<T>(radius * std::sin(angle))});
    }
    return places;
  };
  scene.positions = around(0.3);
  if (has_edges) {
    for (const Point2<T> p : around(0.2)) {
      trismooth::EdgeTensor<T> edges{static_cast<T>(random.between(0.1, 1)), 0, static_cast<T>(random.between(0.1, 1))};
      edges.add(p);
      scene.edges.push_back(edges);
    }
    // Fixed vertices have none.
    scene.edges[static_cast<std::size_t>(random.below(size))] = {};
    scene.edges.insert(scene.edges.begin(), trismooth::EdgeTensor<T>{1, static_cast<T>(0.25), static_cast<T>(0.5)});
  }
  for (std::int32_t i = 0; i <= size; ++i) {
    scene.inverse_areas.push_back(static_cast<T>(size / random.between(2, 10)));
  }
  scene.scales = {static_cast<T>(random.below(3) == 0 ? 0 : random.between(0, 0.5)), 1 + random.below(8)};
  return scene;
}

/// The same with the vertex at a random place where all triangles are positive.
template <class T>
Scene<T> valid_scene(test_meshes::Random& random, bool has_edges) {
  for (;;) {
    Scene<T> scene = star<T>(random, has_edges);
    scene.position = {static_cast<T>(random.between(-0.5, 0.5)), static_cast<T>(random.between(-0.5, 0.5))};
    if (scene.energy(true).smallest_area(naive::widened(scene.position)) > 1e-2L) {
      return scene;
    }
  }
}

struct Derivatives {
  Real x, y, xx, xy, yy;
};

/// By differences of the fourth order.
Derivatives differences(const naive::EnergyRing& ring, Point2<Real> v) {
  const Real h = 1e-4L * ring.smallest_area(v);
  const auto at = [&](int i, int j) { return ring.energy({v.x + h * i, v.y + h * j}); };
  const auto first = [&](const auto& f) { return (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / (12 * h); };
  const auto second = [&](const auto& f) { return (16 * (f(1) + f(-1)) - (f(2) + f(-2)) - 30 * f(0)) / (12 * h * h); };
  const auto along_x = [&](int i) { return at(i, 0); };
  const auto along_y = [&](int i) { return at(0, i); };
  const auto mixed = [&](int i) { return (at(i, i) + at(-i, -i) - at(i, -i) - at(-i, i)) / (4 * h * h * i * i); };
  return {first(along_x), first(along_y), second(along_x), (4 * mixed(1) - mixed(2)) / 3, second(along_y)};
}

struct NewtonStep {
  Point2<Real> step;
  Real gain;  ///< twice what it gains where the energy is quadratic
};

NewtonStep newton_step(const naive::EnergyRing& ring, Point2<Real> v) {
  const Derivatives d = differences(ring, v);
  const Real determinant = d.xx * d.yy - d.xy * d.xy;
  const Point2<Real> step{(d.xy * d.y - d.yy * d.x) / determinant, (d.xy * d.x - d.xx * d.y) / determinant};
  return {step, -(step.x * d.x + step.y * d.y)};
}

/// Whether no triangle is larger than the bound that was not as large before, by a part `slack` of the bound.
template <class T>
bool is_within_bound(const Scene<T>& scene, Point2<Real> target, Real slack) {
  const naive::EnergyRing ring = scene.energy(true);
  for (std::size_t i = 0; i < ring.positions.size(); ++i) {
    const Real before = naive::share(naive::widened(scene.position), ring.positions[i], ring.positions[ring.next(i)]);
    const Real after = naive::share(target, ring.positions[i], ring.positions[ring.next(i)]);
    if (after > std::max(before, static_cast<Real>(scene.largest_share)) * (1 + slack)) {
      return false;
    }
  }
  return true;
}

/// A bound that some of the triangles exceed, or will, or none.
template <class T>
void bound_growth(Scene<T>& scene, test_meshes::Random& random) {
  Real largest = 0;
  const naive::EnergyRing ring = scene.energy(true);
  for (std::size_t i = 0; i < ring.positions.size(); ++i) {
    largest = std::max(largest,
                       naive::share(naive::widened(scene.position), ring.positions[i], ring.positions[ring.next(i)]));
  }
  scene.largest_share = static_cast<T>(largest * random.between(0.3, 2));
}

/// Where the energy is smallest: the best of eight places around, nearer and nearer.
Point2<Real> lowest(const naive::EnergyRing& ring, Point2<Real> from) {
  Real best = ring.energy(from);
  for (Real step = 0.25L; step > 1e-9L;) {
    Point2<Real> next = from;
    for (int i = 0; i < 8; ++i) {
      const Real angle = i * std::numbers::pi_v<Real> / 4 + step;
      const Point2<Real> place{from.x + step * std::cos(angle), from.y + step * std::sin(angle)};
      if (ring.smallest_area(place) > 0 && ring.energy(place) < best) {
        best = ring.energy(place);
        next = place;
      }
    }
    step = next == from ? step / 2 : step;
    from = next;
  }
  return from;
}

Real distance(Point2<Real> a, Point2<Real> b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

TEST_CASE("a visit makes the first step of those tried that lowers the energy, as the energy's differences say") {
  test_meshes::Random random(1);
  int moves = 0;
  int shortened = 0;
  int stays = 0;
  for (int i = 0; i < (is_sanitized ? 300 : 4000); ++i) {
    Scene<double> scene = valid_scene<double>(random, i % 3 == 0);
    if (random.below(2) == 0) {
      bound_growth(scene, random);
    }
    const double relaxation = std::vector{0.7, 1.0, 1.5, 1.9}[random.below(4)];
    const MeanRatioStep<double> step{relaxation, random.below(2) == 0 ? 0 : 3e-4, random.below(2) == 0};
    const naive::EnergyRing ring = scene.energy(step.is_last);
    const Point2<Real> from = naive::widened(scene.position);
    const NewtonStep newton = newton_step(ring, from);
    const Real before = ring.energy(from);
    CAPTURE(i, scene.size(), scene.scales.power, relaxation, step.is_last);

    const Move<double> move = scene.visit(step);
    bool is_clear = std::abs(newton.gain - step.least_gain * before) > 1e-6L * before;
    if (!is_clear) {
      continue;
    }
    Point2<Real> expected = from;
    if (newton.gain > step.least_gain * before) {
      Real length = relaxation;
      for (int tries = 0; tries < 4 && expected == from; ++tries) {
        const Point2<Real> target{from.x + length * newton.step.x, from.y + length * newton.step.y};
        const Real area = ring.smallest_area(target);
        is_clear = is_clear && std::abs(area) > 1e-5L;
        if (area > 0) {
          const Real after = ring.energy(target);
          is_clear = is_clear && std::abs(after - before) > 1e-5L * before &&
                     is_within_bound(scene, target, 1e-5L) == is_within_bound(scene, target, -1e-5L);
          expected = after < before && is_within_bound(scene, target, 0) ? target : from;
        }
        shortened += tries > 0 && !(expected == from) ? 1 : 0;
        length = length > 1 ? 1 : length / 2;
      }
    }
    if (is_clear) {
      const Real off = distance(naive::widened(move.position), expected);
      REQUIRE(static_cast<double>(off) < 4e-6 + 4e-6 * static_cast<double>(distance(expected, from)));
      moves += move.moved ? 1 : 0;
      stays += move.moved ? 0 : 1;
    }
  }
  CHECK(moves > (is_sanitized ? 100 : 2000));
  CHECK(shortened > (is_sanitized ? 10 : 100));
  CHECK(stays > (is_sanitized ? 5 : 100));
}

TEMPLATE_TEST_CASE("every move lowers the energy, leaves all triangles positive, and none grows beyond the bound", "",
                   float, double) {
  test_meshes::Random random(2);
  constexpr Real rounding = 64 * static_cast<Real>(std::numeric_limits<TestType>::epsilon());
  int moves = 0;
  for (int i = 0; i < (is_sanitized ? 2000 : 20000); ++i) {
    Scene<TestType> scene = valid_scene<TestType>(random, i % 3 == 0);
    bound_growth(scene, random);
    const MeanRatioStep<TestType> step{static_cast<TestType>(random.between(0.5, 2)), 0, random.below(2) == 0};
    const Move<TestType> move = scene.visit(step);
    if (!move.moved) {
      REQUIRE(move.position == scene.position);
      continue;
    }
    ++moves;
    const naive::EnergyRing ring = scene.energy(step.is_last);
    const Point2<Real> to = naive::widened(move.position);
    CAPTURE(i, scene.scales.power);
    REQUIRE(ring.smallest_area(to) > 0);
    REQUIRE(ring.energy(to) < ring.energy(naive::widened(scene.position)) * (1 + scene.scales.power * rounding));
    REQUIRE(is_within_bound(scene, to, rounding));
  }
  CHECK(moves > (is_sanitized ? 1000 : 10000));
}

TEST_CASE("visits again and again end where the energy of the ring is smallest, and there the vertex stays") {
  test_meshes::Random random(3);
  for (int i = 0; i < (is_sanitized ? 40 : 300); ++i) {
    Scene<double> scene = valid_scene<double>(random, i % 3 == 0);
    const bool is_last = random.below(2) == 0;
    const naive::EnergyRing ring = scene.energy(is_last);
    const Point2<Real> expected = lowest(ring, naive::widened(scene.position));
    for (int visits = 0; visits < 60; ++visits) {
      scene.position = scene.visit({visits % 2 == 0 ? 1.5 : 1.0, 0, is_last}).position;
    }
    CAPTURE(i, scene.size(), scene.scales.power, scene.scales.size_weight);
    REQUIRE(static_cast<double>(distance(naive::widened(scene.position), expected)) < 1e-6);
    REQUIRE_FALSE(scene.visit({1.5, 1e-10, is_last}).moved);
    // Single precision gets there, too.
    Scene<float> narrow;
    for (const Point2<double> p : scene.positions) {
      narrow.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
    }
    for (const auto& edges : scene.edges) {
      narrow.edges.push_back(
          {static_cast<float>(edges.xx), static_cast<float>(edges.xy), static_cast<float>(edges.yy)});
    }
    narrow.inverse_areas.assign(scene.inverse_areas.begin(), scene.inverse_areas.end());
    narrow.scales = {static_cast<float>(scene.scales.size_weight), scene.scales.power};
    narrow.position = {static_cast<float>(expected.x), static_cast<float>(expected.y)};
    REQUIRE_FALSE(narrow.visit({1.5F, 1e-5F, is_last}).moved);
  }
}

TEMPLATE_TEST_CASE("in the middle of equilateral triangles of the area aimed at a vertex stays", "", float, double) {
  for (int power = 1; power <= 8; ++power) {
    for (const double weight : {0.0, 1.0, 100.0}) {
      Scene<TestType> scene;
      for (int i = 0; i < 6; ++i) {
        const double angle = std::numbers::pi * i / 3 + 0.2;
        scene.positions.push_back({static_cast<TestType>(std::cos(angle)), static_cast<TestType>(std::sin(angle))});
      }
      scene.inverse_areas.assign(7, static_cast<TestType>(2 / std::numbers::sqrt3));
      scene.scales = {static_cast<TestType>(weight / 3), power};
      for (const bool is_last : {false, true}) {
        CHECK_FALSE(scene.visit({static_cast<TestType>(1.5), static_cast<TestType>(1e-4), is_last}).moved);
      }
    }
  }
}

TEMPLATE_TEST_CASE("around an inverted or flat triangle, and where a position is no number, it is the smart rule", "",
                   float, double) {
  test_meshes::Random random(4);
  int moves = 0;
  for (int i = 0; i < 3000; ++i) {
    Scene<TestType> scene = star<TestType>(random, i % 3 == 0);
    const int kind = i % 4;
    const auto which = static_cast<std::size_t>(random.below(scene.size()));
    if (kind == 0) {
      scene.position = {static_cast<TestType>(random.between(-2, 2)), 2};
    } else if (kind == 1) {
      scene.position = scene.positions[which];
    } else if (kind == 2) {
      const TestType bad =
          random.below(2) == 0 ? std::numeric_limits<TestType>::quiet_NaN() : std::numeric_limits<TestType>::infinity();
      (random.below(2) == 0 ? scene.positions[which].x : scene.positions[which].y) = bad;
    } else {
      scene.position.x = std::numeric_limits<TestType>::quiet_NaN();
    }
    const Move<TestType> move = scene.visit({static_cast<TestType>(1.5), static_cast<TestType>(3e-4), i % 2 == 0});
    CAPTURE(i, kind);
    if (kind < 2) {
      const Point2<TestType> expected = naive::updated(Method::smart, scene.position, scene.positions);
      REQUIRE(move.position == expected);
      REQUIRE(move.moved == !(expected == scene.position));
    } else {
      REQUIRE_FALSE(move.moved);
    }
    moves += move.moved ? 1 : 0;
  }
  CHECK(moves > 1000);
}

}  // namespace trismooth::mean_ratio_test

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "trismooth/smoothing/methods/methods.h"

#include "catch.h"
#include "support/same_bits.h"

namespace trismooth::quadrilateral_energy_test {

/// The energy of the elements around the middle of a scene, in its definition: sums of (a^2 + b^2) / (2 cross) over
/// the corners, and of tau + 1 / tau.
struct EnergyScene {
  std::vector<Point2<double>> ring;  ///< neighbours, then the vertices opposite
  std::vector<bool> quadrilaterals;
  std::vector<double> inverse_areas;  ///< by number: the vertex, then the ring
  std::vector<EdgeTensor<double>> edges;
  double third_of_weight;
  int power;

  int size() const { return static_cast<int>(quadrilaterals.size()); }
  Point2<double> operator[](int i) const { return ring[static_cast<std::size_t>(i)]; }
  static std::int32_t number(int i) { return i + 1; }
  bool is_quadrilateral(int i) const { return quadrilaterals[static_cast<std::size_t>(i)]; }

  /// a^2 in the metric of an element, which makes ellipses round that are as flat as the edges around its corners.
  static long double squared(const EdgeTensor<double>* sum, long double x, long double y) {
    if (sum == nullptr) {
      return x * x + y * y;
    }
    const long double determinant =
        static_cast<long double>(sum->xx) * sum->yy - static_cast<long double>(sum->xy) * sum->xy;
    return (sum->yy * x * x - 2 * static_cast<long double>(sum->xy) * x * y + sum->xx * y * y) / std::sqrt(determinant);
  }

  long double energy(long double x, long double y) const {
    long double total = 0;
    for (int i = 0; i < size(); ++i) {
      const int after = (i + 1) % size();
      std::vector<int> others{i};
      if (is_quadrilateral(i)) {
        others.push_back(size() + i);
      }
      others.push_back(after);
      std::vector<std::array<long double, 2>> corners{{x, y}};
      long double inverse = inverse_areas[0];
      EdgeTensor<double> sum;
      if (!edges.empty()) {
        sum = edges[0];
      }
      for (const int k : others) {
        corners.push_back({(*this)[k].x, (*this)[k].y});
        inverse += inverse_areas[static_cast<std::size_t>(number(k))];
        if (!edges.empty()) {
          sum.add(edges[static_cast<std::size_t>(number(k))]);
        }
      }
      const EdgeTensor<double>* const metric = edges.empty() ? nullptr : &sum;
      const std::size_t count = corners.size();
      inverse /= static_cast<long double>(count);
      long double doubled_area = 0;
      long double sides = 0;
      long double shapes = 0;
      for (std::size_t c = 0; c < count; ++c) {
        const auto& here = corners[c];
        const auto& next = corners[(c + 1) % count];
        const auto& previous = corners[(c + count - 1) % count];
        doubled_area += here[0] * next[1] - here[1] * next[0];
        const long double a = squared(metric, next[0] - here[0], next[1] - here[1]);
        const long double b = squared(metric, previous[0] - here[0], previous[1] - here[1]);
        sides += a;
        const long double cross =
            (next[0] - here[0]) * (previous[1] - here[1]) - (next[1] - here[1]) * (previous[0] - here[0]);
        // The corner opposite does not change with the vertex.
        shapes += c == 2 ? 0 : std::pow((a + b) / (2 * cross), static_cast<long double>(power)) / 2;
      }
      if (count == 3) {
        shapes =
            std::pow(sides / (2 * std::numbers::sqrt3_v<long double> * doubled_area), static_cast<long double>(power));
      }
      const long double tau = (count == 4 ? doubled_area / 2 : doubled_area) * inverse;
      total += shapes + power * third_of_weight * (tau + 1 / tau);
    }
    return total;
  }
};

EnergyScene random_scene(std::mt19937_64& random, bool is_shaped) {
  std::uniform_real_distribution<double> some(0.6, 1.4);
  const int size = 3 + static_cast<int>(random() % 4);
  EnergyScene scene;
  const auto at = [&](double turn, double radius) {
    const double angle = 2 * std::numbers::pi * turn / size;
    scene.ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  };
  for (int i = 0; i < size; ++i) {
    at(i, some(random));
    scene.quadrilaterals.push_back(random() % 3 != 0);
  }
  for (int i = 0; i < size; ++i) {
    at(i + 0.5, 1.8 * some(random));
  }
  for (int i = 0; i <= 2 * size; ++i) {
    scene.inverse_areas.push_back(some(random));
    if (is_shaped) {
      const double lean = some(random) - 1;
      scene.edges.push_back({some(random), lean, some(random)});
    }
  }
  scene.third_of_weight = random() % 4 == 0 ? 0 : some(random);
  scene.power = 1 + static_cast<int>(random() % 4);
  return scene;
}

TEST_CASE("the energy of quadrilaterals and its derivatives are those of its definition") {
  std::mt19937_64 random(8);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const EnergyScene scene = random_scene(random, i % 2 == 1);
    std::uniform_real_distribution<double> near(-0.1, 0.1);
    const Point2<double> place{near(random), near(random)};
    const double largest = std::numeric_limits<double>::infinity();
    const MeanRatioScales<double> scales{scene.third_of_weight, scene.power, 0};
    MeanRatioTargets<double> targets{scene.inverse_areas.data(), &largest, &scales};
    const auto check = [&](const auto& method) {
      const MeanRatioEnergy<double, 0> energy{scene.power, scene.third_of_weight, 0};
      const auto fetch = [&](int k) {
        struct Node {
          Point2<double> position;
          double inverse_area;
          std::int32_t number;
        };
        return Node{scene[k], scene.inverse_areas[static_cast<std::size_t>(k) + 1], k + 1};
      };
      const auto side = [&](const auto& corner) {
        return side_of<double>(corner, scene.inverse_areas[0],
                               method.metric(0, corner.with([](const auto& of) { return of.number; })));
      };
      const auto sides = sides_in_turn<double>(scene, fetch, side);
      const auto at = sides.template totals<7>(place, [&](const auto& e) { return energy.expansion(e); });
      const auto alone = sides.template totals<1>(place, [&](const auto& e) { return energy.value(e); });
      if (!(at.smallest_margin > 0)) {
        return;
      }
      ++compared;
      const auto value = [&](double x, double y) {
        return scene.energy(static_cast<long double>(place.x) + x, static_cast<long double>(place.y) + y);
      };
      const long double here = value(0, 0);
      CAPTURE(i, scene.power, scene.size());
      const double scale = static_cast<double>(here);
      REQUIRE(at.sums[0] == Approx(scale).epsilon(1e-13));
      REQUIRE(same_bits(alone.sums[0], at.sums[0]));
      constexpr double h = 1e-4;
      const double p = scene.power;
      const auto close = [&](double found, long double expected) {
        return std::abs(p * found - static_cast<double>(expected)) <
               1e-5 * (1 + std::abs(static_cast<double>(expected)));
      };
      REQUIRE(close(at.sums[1], (value(h, 0) - value(-h, 0)) / (2 * h)));
      REQUIRE(close(at.sums[2], (value(0, h) - value(0, -h)) / (2 * h)));
      REQUIRE(close(at.sums[3], (value(h, 0) - 2 * here + value(-h, 0)) / (h * h)));
      REQUIRE(close(at.sums[4], (value(h, h) - value(h, -h) - value(-h, h) + value(-h, -h)) / (4 * h * h)));
      REQUIRE(close(at.sums[5], (value(0, h) - 2 * here + value(0, -h)) / (h * h)));
      REQUIRE(at.sums[6] == Approx(squares_around(place, scene)).epsilon(1e-14));
    };
    if (scene.edges.empty()) {
      check(MeanRatio<double, false, true>(targets, {}));
    } else {
      targets.edges = &scene.edges.front();
      check(MeanRatio<double, true, true>(targets, {}));
    }
  }
  CHECK(compared > 200);
}

}  // namespace trismooth::quadrilateral_energy_test

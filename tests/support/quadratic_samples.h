// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

/// The Jacobian of quadratic elements from their shape functions. `at(node, axis)` is a coordinate: corners first,
/// counter-clockwise, then the middles of the sides behind them, then the centre.
namespace quadratic_samples {

/// At the place (u, v) of the unit square, of a quadrilateral of nine nodes (products of the parabolas that are 1 at
/// one of 0, 1/2 and 1) or of eight (the serendipity functions, in -1..1).
template <class At>
double jacobian_of_quad(std::size_t nodes, const At& at, double u, double v) {
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  const auto add = [&](std::size_t node, double by_u, double by_v) {
    x1 += by_u * at(node, 0);
    y1 += by_u * at(node, 1);
    x2 += by_v * at(node, 0);
    y2 += by_v * at(node, 1);
  };
  if (nodes == 9) {
    constexpr std::array<std::array<std::size_t, 2>, 9> places{
        {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}}};
    const auto value = [](std::size_t i, double t) {
      return i == 0 ? (1 - t) * (1 - 2 * t) : i == 1 ? 4 * t * (1 - t) : t * (2 * t - 1);
    };
    const auto slope = [](std::size_t i, double t) { return i == 0 ? 4 * t - 3 : i == 1 ? 4 - 8 * t : 4 * t - 1; };
    for (std::size_t node = 0; node < 9; ++node) {
      const auto [i, j] = places[node];
      add(node, slope(i, u) * value(j, v), value(i, u) * slope(j, v));
    }
  } else {
    const double s = 2 * u - 1;
    const double t = 2 * v - 1;
    constexpr std::array<std::array<double, 2>, 8> places{
        {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    for (std::size_t node = 0; node < 8; ++node) {
      const auto [p, q] = places[node];
      // d/du = 2 d/ds.
      if (node < 4) {  // (1 + p s) (1 + q t) (p s + q t - 1) / 4
        add(node, p * (1 + q * t) * (2 * p * s + q * t) / 2, q * (1 + p * s) * (2 * q * t + p * s) / 2);
      } else if (p == 0) {  // (1 - s^2) (1 + q t) / 2
        add(node, -2 * s * (1 + q * t), (1 - s * s) * q);
      } else {  // (1 + p s) (1 - t^2) / 2
        add(node, p * (1 - t * t), -2 * t * (1 + p * s));
      }
    }
  }
  return x1 * y2 - y1 * x2;
}

}  // namespace quadratic_samples

/// The smallest of many values of the Jacobian of a triangle of six nodes.
template <class At>
double smallest_jacobian_sample(const At& at) {
  constexpr int steps = 20;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double l1 = double(i) / steps;
      const double l2 = double(j) / steps;
      const double l0 = 1 - l1 - l2;
      const std::array<double, 6> by_l1{1 - 4 * l0, 4 * l1 - 1, 0, 4 * (l0 - l1), 4 * l2, -4 * l2};
      const std::array<double, 6> by_l2{1 - 4 * l0, 0, 4 * l2 - 1, -4 * l1, 4 * l1, 4 * (l0 - l2)};
      double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
      for (std::size_t node = 0; node < 6; ++node) {
        x1 += by_l1[node] * at(node, 0);
        y1 += by_l1[node] * at(node, 1);
        x2 += by_l2[node] * at(node, 0);
        y2 += by_l2[node] * at(node, 1);
      }
      smallest = std::min(smallest, x1 * y2 - y1 * x2);
    }
  }
  return smallest;
}

/// The smallest of many values of the Jacobian of a quadrilateral of eight or nine nodes.
template <class At>
double smallest_jacobian_sample_of_quad(std::size_t nodes, const At& at) {
  constexpr int steps = 20;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      smallest =
          std::min(smallest, quadratic_samples::jacobian_of_quad(nodes, at, double(i) / steps, double(j) / steps));
    }
  }
  return smallest;
}
